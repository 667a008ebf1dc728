#include "sph/taylorGreenFlow.hpp"

#include <cmath>
#include <numbers>

namespace corpuscle::sph {

const Schema<TaylorGreenFlow>& TaylorGreenFlow::schema() {
    static const Schema<TaylorGreenFlow> s =
        Schema<TaylorGreenFlow>("taylorGreen", "decaying vortices in the x-z plane")
            .quantity("speed", &TaylorGreenFlow::speed, unit::metrePerSecond, "largest speed U at t = 0",
                      {.range = positive});
    return s;
}

FlowState TaylorGreenFlow::resolve(const FlowContext& context, const Mark& mark, Problems& problems) const {
    FlowState flow;
    const Vec3 size = context.box.size();
    if (std::abs(size[0] - size[2]) > 1e-9 * size[0]) {
        problems.add(mark, "type",
                     "taylorGreen needs a box as long along x as along z; system/mesh.yaml has " +
                         formatQuantity(size[0], unit::metre) + " and " + formatQuantity(size[2], unit::metre));
        return flow;
    }
    const double k = 2 * std::numbers::pi / size[0], U = speed, rho = context.density;
    const Vec3 low = context.box.low;
    flow.density = rho;
    flow.speed = U;
    flow.length = 1 / k;
    flow.rate = U * k;
    flow.transient = rho / (2 * context.viscosity * k * k);
    flow.velocity = [=](const Vec3& p) {
        const double x = k * (p[0] - low[0]), z = k * (p[2] - low[2]);
        return Vec3(U * std::sin(x) * std::cos(z), 0, -U * std::cos(x) * std::sin(z));
    };
    flow.pressure = [=](const Vec3& p) {
        const double x = k * (p[0] - low[0]), z = k * (p[2] - low[2]);
        return 0.25 * rho * U * U * (std::cos(2 * x) + std::cos(2 * z));
    };
    return flow;
}

CORPUSCLE_REGISTER(Flow, TaylorGreenFlow, "taylorGreen", "decaying Taylor-Green vortices in a periodic box");

}  // namespace corpuscle::sph
