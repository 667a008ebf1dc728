#include "sph/poiseuilleFlow.hpp"

#include <cmath>
#include <numbers>

namespace corpuscle::sph {

const Schema<PoiseuilleFlow>& PoiseuilleFlow::schema() {
    static const Schema<PoiseuilleFlow> s =
        Schema<PoiseuilleFlow>("poiseuille", "flow between two walls at rest, driven by a body force along x")
            .quantity("bodyForce", &PoiseuilleFlow::bodyForce, unit::metrePerSecond2, "force per unit mass along x",
                      {.range = positive})
            .table("walls", &PoiseuilleFlow::walls, "the two walls", {.fallback = "{normal: z}"})
            .word("start", &PoiseuilleFlow::start, {"rest", "parabola"}, "velocity at t = 0", {.fallback = "rest"})
            .atRestart(AtRestart::noted, {"bodyForce"})
            .atRestart(AtRestart::fixed, {"walls", "start"});
    return s;
}

FlowState PoiseuilleFlow::resolve(const FlowContext& context, const Mark& mark, Problems& problems) const {
    const int axis = walls.axis();
    FlowState flow;
    if (axis == 0) {
        problems.add(mark, "walls.normal", "found x, but the flow goes along x; allowed are y, z");
        return flow;
    }
    const double low = context.box.low[axis], high = context.box.high[axis], gap = high - low;
    const double curvature = bodyForce * context.density / (2 * context.viscosity),
                 largest =
                     bodyForce * context.density / (2 * context.leastViscosity);  // if all were the thinnest layer
    flow.density = context.density;
    flow.speed = 0.25 * largest * gap * gap;
    flow.length = gap;
    flow.rate = flow.speed / gap;
    flow.settles = true;
    if (start == "rest" || context.layered)
        flow.transient = std::pow(gap / std::numbers::pi, 2) * context.density / context.leastViscosity;
    flow.bodyForce = Vec3(bodyForce, 0, 0);
    flow.walls.axis = axis;
    flow.walls.low = low;
    flow.walls.high = high;
    const double scale = start == "parabola" ? curvature : 0;
    flow.velocity = [=](const Vec3& p) { return Vec3(scale * (p[axis] - low) * (high - p[axis]), 0, 0); };
    flow.pressure = [](const Vec3&) { return 0.0; };
    return flow;
}

CORPUSCLE_REGISTER(Flow, PoiseuilleFlow, "poiseuille", "flow between two walls at rest, driven by a body force");

}  // namespace corpuscle::sph
