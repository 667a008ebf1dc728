#include "sph/abcFlow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace corpuscle::sph {

const Schema<AbcFlow>& AbcFlow::schema() {
    static const Schema<AbcFlow> s =
        Schema<AbcFlow>("abc", "decaying Arnold-Beltrami-Childress flow in a cube")
            .quantity("A", &AbcFlow::A, unit::metrePerSecond, "of sin kz along x and cos kz along y, at t = 0",
                      {.range = nonNegative})
            .quantity("B", &AbcFlow::B, unit::metrePerSecond, "of sin kx along y and cos kx along z, at t = 0",
                      {.range = nonNegative})
            .quantity("C", &AbcFlow::C, unit::metrePerSecond, "of sin ky along z and cos ky along x, at t = 0",
                      {.range = nonNegative})
            .check([](const AbcFlow& f, const Node& node, Problems& problems) {
                if (const Node* given = node.find("A"); given && f.A == 0 && f.B == 0 && f.C == 0)
                    problems.add(given->mark, given->path, "found A, B and C all zero; at least one above 0 is needed");
            })
            .atRestart(AtRestart::fixed, {"A", "B", "C"});
    return s;
}

FlowState AbcFlow::resolve(const FlowContext& context, const Mark& mark, Problems& problems) const {
    FlowState flow;
    if (!equallyLong("abc", context.box, "xyz", mark, problems)) return flow;
    const double k = 2 * std::numbers::pi / context.box.size()[0], rho = context.density;
    const double a = A, b = B, c = C;
    const Vec3 low = context.box.low;
    flow.density = rho;
    // u^2 is A^2 + B^2 + C^2 plus twice the sum of the products in p. Each product, as A B sin kx cos kz, is at most
    // half its amplitude times the sum of the squares of sine and cosine: this gives an upper bound, reached for
    // A = B = C.
    flow.speed =
        std::sqrt(a * a + b * b + c * c + std::max(a * b, b * c) + std::max(b * c, c * a) + std::max(c * a, a * b));
    flow.length = 1 / k;
    flow.rate = flow.speed * k;
    flow.transient = rho / (context.viscosity * k * k);
    flow.velocity = [=](const Vec3& p) {
        const double x = k * (p[0] - low[0]), y = k * (p[1] - low[1]), z = k * (p[2] - low[2]);
        return Vec3(a * std::sin(z) + c * std::cos(y), b * std::sin(x) + a * std::cos(z),
                    c * std::sin(y) + b * std::cos(x));
    };
    flow.pressure = [=](const Vec3& p) {
        const double x = k * (p[0] - low[0]), y = k * (p[1] - low[1]), z = k * (p[2] - low[2]);
        return -rho * (a * b * std::sin(x) * std::cos(z) + b * c * std::sin(y) * std::cos(x) +
                       c * a * std::sin(z) * std::cos(y));
    };
    return flow;
}

CORPUSCLE_REGISTER(Flow, AbcFlow, "abc", "decaying Arnold-Beltrami-Childress flow in a periodic cube");

}  // namespace corpuscle::sph
