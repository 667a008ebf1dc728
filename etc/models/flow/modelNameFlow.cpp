#include "sph/modelNameFlow.hpp"

namespace corpuscle::sph {

const Schema<ModelNameFlow>& ModelNameFlow::schema() {
    static const Schema<ModelNameFlow> s =
        Schema<ModelNameFlow>("modelName", "a uniform stream along x")
            .quantity("speed", &ModelNameFlow::speed, unit::metrePerSecond, "its speed U", {.range = positive})
            .atRestart(AtRestart::fixed, {"speed"});
    return s;
}

FlowState ModelNameFlow::resolve(const FlowContext& context, const Mark& /*mark*/, Problems& /*problems*/) const {
    FlowState flow;
    flow.density = context.density;
    flow.speed = speed;
    flow.length = context.box.size()[0];
    flow.rate = speed / flow.length;
    flow.velocity = [U = speed](const Vec3&) { return Vec3(U, 0, 0); };
    flow.pressure = [](const Vec3&) { return 0.0; };
    return flow;
}

CORPUSCLE_REGISTER(Flow, ModelNameFlow, "modelName", "a uniform stream along x");

}  // namespace corpuscle::sph
