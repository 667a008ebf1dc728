#include "sph/poiseuilleFlow.hpp"

namespace corpuscle::sph {

const Schema<PoiseuilleFlow>& PoiseuilleFlow::schema() {
    static const Schema<PoiseuilleFlow> s =
        Schema<PoiseuilleFlow>("poiseuille", "flow between walls at rest, driven along x")
            .quantity("bodyForce", &PoiseuilleFlow::bodyForce, unit::metrePerSecond2, "force per unit mass along x",
                      {.range = positive})
            .quantity("pressureDrop", &PoiseuilleFlow::pressureDrop, unit::pascal,
                      "fall of the pressure along the box, instead of a body force", {.range = positive})
            .quantity("flowRate", &PoiseuilleFlow::flowRate, unit::metre3PerSecond,
                      "volume in unit time through a cross-section, which the body force follows", {.range = positive})
            .exactlyOneOf({"bodyForce", "pressureDrop", "flowRate"})
            .model("walls", &PoiseuilleFlow::wallShape, "planes, a tube, a duct or a vessel",
                   {.fallback = "{normal: z}"})
            .word("start", &PoiseuilleFlow::start, {"rest", "parabola"}, "velocity at t = 0", {.fallback = "rest"})
            .model("drive", &PoiseuilleFlow::driveModel,
                   "factor of body force, pressure drop or flow rate, which may change with time",
                   {.fallback = "steady"})
            .atRestart(AtRestart::noted, {"bodyForce", "pressureDrop", "flowRate", "drive"})
            .atRestart(AtRestart::fixed, {"walls", "start"});
    return s;
}

FlowState PoiseuilleFlow::resolve(const FlowContext& context, const Mark& mark, Problems& problems) const {
    FlowState flow;
    checkWalls(*wallShape, false, mark, problems);
    wallShape->check(context.box, mark, problems);
    const std::optional<int> across = wallShape->planesAcross();
    if (start == "parabola" && !across)
        problems.add(mark, "start",
                     "found parabola, the flow between two parallel planes; with these walls write rest");
    if (!problems.empty()) return flow;
    flow.walls = wallShape->place(context.box);
    const boundary::Hydraulics hydraulics = wallShape->hydraulics(context.box);
    flow.varies = !wallShape->isStraight();
    flow.section = wallShape->volume(context.box) / context.box.size()[0];
    flow.conductance = hydraulics.conductance;
    // Without a closed form, the mean velocity is taken to be half the largest one.
    const double conductance = hydraulics.conductance.value_or(0.5 * hydraulics.fastest * flow.section);
    flow.flowRate = flowRate.value_or(0);
    const double force = bodyForce      ? *bodyForce
                         : pressureDrop ? *pressureDrop / (context.density * context.box.size()[0])
                                        : *flowRate * context.viscosity / (context.density * conductance);
    flow.density = context.density;
    // As if all had the least viscosity.
    flow.speed = hydraulics.fastest * force * context.density / context.leastViscosity;
    flow.length = hydraulics.width;
    flow.rate = flow.speed / hydraulics.width;
    flow.settles = true;
    if (start == "rest" || context.layered)
        flow.transient = hydraulics.settling * context.density / context.leastViscosity;
    if (hydraulics.settling > 0) flow.confinement = 1 / hydraulics.settling;
    flow.bodyForce = Vec3(force, 0, 0);
    flow.velocity = [](const Vec3&) { return Vec3(0, 0, 0); };
    if (across) {
        const int axis = flow.gradient = *across;
        const double low = context.box.low[axis], high = context.box.high[axis],
                     scale = start == "parabola" ? force * context.density / (2 * context.viscosity) : 0;
        flow.velocity = [=](const Vec3& p) { return Vec3(scale * (p[axis] - low) * (high - p[axis]), 0, 0); };
    }
    flow.pressure = [](const Vec3&) { return 0.0; };
    flow.setDrive(driveModel);
    return flow;
}

CORPUSCLE_REGISTER(Flow, PoiseuilleFlow, "poiseuille",
                   "flow between walls at rest, driven along x by a body force, a pressure drop or a flow rate");

}  // namespace corpuscle::sph
