#include "sph/poiseuilleFlow.hpp"

#include <cmath>
#include <numbers>

namespace corpuscle::sph {

const Schema<PoiseuilleFlow>& PoiseuilleFlow::schema() {
    static const Schema<PoiseuilleFlow> s =
        Schema<PoiseuilleFlow>("poiseuille", "flow between two walls at rest, driven by a body force along x")
            .quantity("bodyForce", &PoiseuilleFlow::bodyForce, unit::metrePerSecond2, "force per unit mass along x",
                      {.range = positive})
            .model("walls", &PoiseuilleFlow::wallShape, "the two walls", {.fallback = "{normal: z}"})
            .word("start", &PoiseuilleFlow::start, {"rest", "parabola"}, "velocity at t = 0", {.fallback = "rest"})
            .atRestart(AtRestart::noted, {"bodyForce"})
            .atRestart(AtRestart::fixed, {"walls", "start"});
    return s;
}

FlowState PoiseuilleFlow::resolve(const FlowContext& context, const Mark& mark, Problems& problems) const {
    FlowState flow;
    checkWalls(*wallShape, false, mark, problems);
    const std::optional<int> across = wallShape->planesAcross();
    if (start == "parabola" && !across)
        problems.add(mark, "start",
                     "found parabola, the flow between two parallel planes; with these walls write rest");
    if (!problems.empty()) return flow;
    flow.walls = wallShape->place(context.box);
    double area = 0;
    for (const boundary::Wall& wall : flow.walls) area += wall.surface->area();
    // gap: for planes the distance between them, for a tube its radius; the flow in a tube is up to twice as fast.
    const double gap = 2 * wallShape->volume(context.box) / area, fastest = across ? 0.25 : 0.5,
                 slowest = across ? std::numbers::pi : 2;
    const double curvature = bodyForce * context.density / (2 * context.viscosity),
                 largest =
                     bodyForce * context.density / (2 * context.leastViscosity);  // if all had the least viscosity
    flow.density = context.density;
    flow.speed = fastest * largest * gap * gap;
    flow.length = gap;
    flow.rate = flow.speed / gap;
    flow.settles = true;
    if (start == "rest" || context.layered)
        flow.transient = std::pow(gap / slowest, 2) * context.density / context.leastViscosity;
    flow.bodyForce = Vec3(bodyForce, 0, 0);
    flow.velocity = [](const Vec3&) { return Vec3(0, 0, 0); };
    if (across) {
        const int axis = flow.gradient = *across;
        const double low = context.box.low[axis], high = context.box.high[axis],
                     scale = start == "parabola" ? curvature : 0;
        flow.velocity = [=](const Vec3& p) { return Vec3(scale * (p[axis] - low) * (high - p[axis]), 0, 0); };
    }
    flow.pressure = [](const Vec3&) { return 0.0; };
    return flow;
}

CORPUSCLE_REGISTER(Flow, PoiseuilleFlow, "poiseuille", "flow between two walls at rest, driven by a body force");

}  // namespace corpuscle::sph
