#include "sph/taylorGreenFlow.hpp"

#include <cmath>
#include <numbers>

namespace corpuscle::sph {

const Schema<TaylorGreenFlow>& TaylorGreenFlow::schema() {
    static const Schema<TaylorGreenFlow> s =
        Schema<TaylorGreenFlow>("taylorGreen", "decaying vortices in the x-z plane, or in a cube")
            .quantity("speed", &TaylorGreenFlow::speed, unit::metrePerSecond, "largest speed U at t = 0",
                      {.range = positive})
            .integer("dimensions", &TaylorGreenFlow::dimensions,
                     "2: vortices in the x-z plane, the same all along y; 3: in a cube",
                     {.fallback = "2", .range = between(2, 3)})
            .atRestart(AtRestart::fixed, {"speed", "dimensions"});
    return s;
}

FlowState TaylorGreenFlow::resolve(const FlowContext& context, const Mark& mark, Problems& problems) const {
    FlowState flow;
    const bool cube = dimensions == 3;
    if (!equallyLong("taylorGreen", context.box, cube ? "xyz" : "xz", mark, problems)) return flow;
    const double k = 2 * std::numbers::pi / context.box.size()[0], U = speed, rho = context.density;
    const Vec3 low = context.box.low;
    flow.density = rho;
    flow.speed = U;
    flow.length = 1 / k;
    flow.rate = U * k;
    flow.transient = rho / (static_cast<double>(dimensions) * context.viscosity * k * k);
    flow.velocity = [=](const Vec3& p) {
        const double x = k * (p[0] - low[0]), y = k * (p[1] - low[1]), z = k * (p[2] - low[2]);
        if (cube)
            return Vec3(U * std::sin(x) * std::cos(y) * std::cos(z), -U * std::cos(x) * std::sin(y) * std::cos(z), 0);
        return Vec3(U * std::sin(x) * std::cos(z), 0, -U * std::cos(x) * std::sin(z));
    };
    flow.pressure = [=](const Vec3& p) {
        const double x = k * (p[0] - low[0]), y = k * (p[1] - low[1]), z = k * (p[2] - low[2]);
        if (cube) return rho * U * U / 16 * (std::cos(2 * x) + std::cos(2 * y)) * (std::cos(2 * z) + 2);
        return 0.25 * rho * U * U * (std::cos(2 * x) + std::cos(2 * z));
    };
    return flow;
}

CORPUSCLE_REGISTER(Flow, TaylorGreenFlow, "taylorGreen", "decaying Taylor-Green vortices in a periodic box");

}  // namespace corpuscle::sph
