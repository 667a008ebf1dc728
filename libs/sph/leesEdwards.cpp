#include "sph/leesEdwards.hpp"

namespace corpuscle::sph {

const Schema<LeesEdwards>& LeesEdwards::schema() {
    static const Schema<LeesEdwards> s =
        Schema<LeesEdwards>("leesEdwards", "simple shear without walls, of sliding periodic images")
            .include<ShearRate>()
            .word("gradient", &LeesEdwards::gradient, {"y", "z"},
                  "axis along which the velocity, which is along x, changes", {.fallback = "z"})
            .atRestart(AtRestart::fixed, {"gradient"});
    return s;
}

FlowState LeesEdwards::resolve(const FlowContext& context, const Mark& mark, Problems& problems) const {
    FlowState flow;
    resolveRate(context, mark, problems, flow);
    if (!problems.empty()) return flow;
    const int axis = gradient[0] - 'x';
    const double length = context.box.size()[axis], middle = context.box.middle()[axis], rate = flow.shearRate;
    flow.gradient = axis;
    flow.speed = 0.5 * rate * length;
    flow.length = length;
    flow.settles = true;
    flow.slide = rate * length * Vec3::UnitX();
    flow.velocity = [=](const Vec3& p) { return Vec3(rate * (p[axis] - middle), 0, 0); };
    flow.pressure = [](const Vec3&) { return 0.0; };
    return flow;
}

CORPUSCLE_REGISTER(Flow, LeesEdwards, "leesEdwards",
                   "simple shear without walls, of periodic images that slide past each other");

}  // namespace corpuscle::sph
