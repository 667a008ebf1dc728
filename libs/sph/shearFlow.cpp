#include "sph/shearFlow.hpp"

#include <cmath>
#include <numbers>

namespace corpuscle::sph {

const Schema<ShearFlow>& ShearFlow::schema() {
    static const Schema<ShearFlow> s =
        Schema<ShearFlow>("shear", "simple shear between two moving walls")
            .include<ShearRate>()
            .model("walls", &ShearFlow::wallShape, "the two moving walls", {.fallback = "{normal: z}"})
            .word("start", &ShearFlow::start, {"linear", "rest"},
                  "velocity at t = 0: the linear profile, or fluid at rest", {.fallback = "linear"})
            .model("drive", &ShearFlow::driveModel, "factor of the walls' velocity, which may change with time",
                   {.fallback = "steady"})
            .atRestart(AtRestart::fixed, {"walls", "start"})
            .atRestart(AtRestart::noted, {"drive"});
    return s;
}

FlowState ShearFlow::resolve(const FlowContext& context, const Mark& mark, Problems& problems) const {
    FlowState flow;
    resolveRate(context, mark, problems, flow);
    checkWalls(*wallShape, true, mark, problems);
    if (!problems.empty()) return flow;
    const int axis = *wallShape->planesAcross();
    const double gap = context.box.size()[axis], middle = 0.5 * (context.box.low[axis] + context.box.high[axis]);
    flow.speed = 0.5 * flow.shearRate * gap;
    flow.length = gap;
    flow.settles = true;
    if (start == "rest" || context.layered)
        flow.transient = std::pow(gap / (2 * std::numbers::pi), 2) * flow.density / context.leastViscosity;
    flow.gradient = axis;
    flow.walls = wallShape->place(context.box);
    for (const boundary::Wall& wall : flow.walls)
        flow.wallVelocities.emplace_back(-flow.speed * wall.normal(Vec3::Zero())[axis], 0, 0);
    FlowState::moveWalls(flow.wallVelocities, 1, flow.walls);
    const double rate = start == "linear" ? flow.shearRate : 0;
    flow.velocity = [=](const Vec3& p) { return Vec3(rate * (p[axis] - middle), 0, 0); };
    flow.pressure = [](const Vec3&) { return 0.0; };
    flow.setDrive(driveModel);
    return flow;
}

CORPUSCLE_REGISTER(Flow, ShearFlow, "shear", "simple shear between two walls moving against each other");

}  // namespace corpuscle::sph
