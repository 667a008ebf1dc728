// Initial velocity and pressure of the periodic flows, compared with the equations that they solve by fourth-order
// finite differences.
#include <gtest/gtest.h>

#include "sph/abcFlow.hpp"
#include "sph/samples.hpp"
#include "sph/taylorGreenFlow.hpp"

using namespace corpuscle;
using namespace corpuscle::sph;
using namespace corpuscle::sph::testing;

namespace {

constexpr double L = 2, mu = 0.3, density = 1.5, nu = mu / density, k = std::numbers::pi;  // k = 2 pi/L
constexpr double step = 5e-3 * L;                                                          // of the finite differences

FlowState resolved(const std::string& text, const Vec3& size = {L, L, L}) {
    Problems problems;
    FlowState flow = choose<Flow>(text)->resolve({.box = {-0.5 * size, 0.5 * size, {true, true, true}},
                                                  .viscosity = mu,
                                                  .density = density,
                                                  .leastViscosity = mu},
                                                 {"constant/flow.yaml", 0, 0}, problems);
    problems.throwIfAny();
    return flow;
}

template <class F>
std::invoke_result_t<F, const Vec3&> derivative(F&& f, const Vec3& x, int axis) {
    const Vec3 d = step * Vec3::Unit(axis);
    return (8 * (f(Vec3(x + d)) - f(Vec3(x - d))) - (f(Vec3(x + 2 * d)) - f(Vec3(x - 2 * d)))) / (12 * step);
}
Mat3 gradient(const FlowState& flow, const Vec3& x) {  // element (i, j): derivative of u_i along j
    Mat3 G;
    for (int j = 0; j < 3; ++j) G.col(j) = derivative([&](const Vec3& p) -> Vec3 { return flow.velocity(p); }, x, j);
    return G;
}
template <class F>
auto laplacian(F&& f, const Vec3& x) {
    auto sum = derivative([&](const Vec3& p) { return derivative(f, p, 0); }, x, 0);
    for (int j = 1; j < 3; ++j) sum += derivative([&](const Vec3& p) { return derivative(f, p, j); }, x, j);
    return sum;
}
std::vector<Vec3> places() {
    std::vector<Vec3> all;
    for (const Particle& p : lattice({3, 3, 3}, 0.4, 7)) all.push_back((L / 3) * (p.x - Vec3(1.5, 1.5, 1.5)));
    return all;
}

struct PeriodicFlow {
    const char *name, *text;
    double decay;   // rate of decay of the velocity, in nu k^2
    double energy;  // kinetic energy per mass at t = 0, mean over the box, for the amplitudes of `text`
    double fastest;
    bool similar;  // keeps its shape at any Reynolds number
};
const PeriodicFlow periodicFlows[] = {
    {"plane", "{type: taylorGreen, speed: 2 m/s}", 2, 1, 2, true},
    {"cube", "{type: taylorGreen, speed: 2 m/s, dimensions: 3}", 3, 0.5, 2, false},
    {"abc", "{type: abc, A: 1 m/s, B: 1 m/s, C: 1 m/s}", 1, 1.5, 2.449489742783178, true},
    {"abcUneven", "{type: abc, A: 1 m/s, B: 0.7 m/s, C: 0.4 m/s}", 1, 0.825, 0, true},
};

class PeriodicFlows : public ::testing::TestWithParam<PeriodicFlow> {};

}  // namespace

TEST_P(PeriodicFlows, haveNoDivergence) {
    const FlowState flow = resolved(GetParam().text);
    for (const Vec3& x : places()) EXPECT_NEAR(gradient(flow, x).trace(), 0, 1e-12) << x.transpose();
}

// nu lap u = -decay nu k^2 u; if the flow keeps its shape, the pressure gradient balances the rest of the momentum
// equation.
TEST_P(PeriodicFlows, solveTheMomentumEquation) {
    const FlowState flow = resolved(GetParam().text);
    for (const Vec3& x : places()) {
        const Vec3 u = flow.velocity(x);
        const Vec3 spread = laplacian([&](const Vec3& p) -> Vec3 { return flow.velocity(p); }, x);
        EXPECT_LT((spread + GetParam().decay * k * k * u).norm(), 1e-5 * k * k) << x.transpose();
        if (!GetParam().similar) continue;
        Vec3 push;
        for (int j = 0; j < 3; ++j) push[j] = derivative(flow.pressure, x, j);
        EXPECT_LT((density * gradient(flow, x) * u + push).norm(), 1e-4 * density * k) << x.transpose();
    }
}

// lap p = -rho sum_ij (du_i/dx_j)(du_j/dx_i): the pressure that keeps the divergence zero, whether or not the flow
// keeps its shape.
TEST_P(PeriodicFlows, startWithTheirPressure) {
    const FlowState flow = resolved(GetParam().text);
    double largest = 0;
    for (const Vec3& x : places()) {
        const Mat3 G = gradient(flow, x);
        const double source = -density * (G * G).trace();
        largest = std::max(largest, std::abs(source));
        EXPECT_NEAR(laplacian(flow.pressure, x), source, 1e-4 * density * k * k) << x.transpose();
    }
    EXPECT_GT(largest, 0.1 * density * k * k);
}

TEST_P(PeriodicFlows, haveTheirKineticEnergySpeedAndTime) {
    const FlowState flow = resolved(GetParam().text);
    double energy = 0, fastest = 0, pressure = 0;
    constexpr int n = 16;  // enough: the sum of a trigonometric polynomial is exact
    for (const Particle& p : lattice({n, n, n}, 0)) {
        const Vec3 x = L / n * (p.x - Vec3::Constant(0.5 * n));
        energy += 0.5 * flow.velocity(x).squaredNorm() / (n * n * n);
        pressure += flow.pressure(x) / (n * n * n);
        fastest = std::max(fastest, flow.velocity(x).norm());
    }
    EXPECT_NEAR(energy, GetParam().energy, 1e-12);
    EXPECT_NEAR(pressure, 0, 1e-12);
    EXPECT_LE(fastest, flow.speed);
    EXPECT_GT(fastest, 0.9 * flow.speed);
    if (GetParam().fastest > 0) {
        EXPECT_NEAR(flow.speed, GetParam().fastest, 1e-12);
    }
    EXPECT_NEAR(flow.transient, 1 / (GetParam().decay * nu * k * k), 1e-12);
    EXPECT_NEAR(flow.length, 1 / k, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Flows, PeriodicFlows, ::testing::ValuesIn(periodicFlows),
                         [](const auto& instance) { return instance.param.name; });

// Compared with the formulas of the headers, with coordinates from the lower corner of the box.
TEST(TaylorGreen, hasItsValuesInACube) {
    const FlowState flow = resolved("{type: taylorGreen, speed: 2 m/s, dimensions: 3}");
    const double x = 0.3, y = 0.5, z = 0.2;
    const Vec3 u = flow.velocity(Vec3(x - 1, y - 1, z - 1));
    EXPECT_NEAR(u[0], 2 * std::sin(k * x) * std::cos(k * y) * std::cos(k * z), 1e-14);
    EXPECT_NEAR(u[1], -2 * std::cos(k * x) * std::sin(k * y) * std::cos(k * z), 1e-14);
    EXPECT_EQ(u[2], 0);
    EXPECT_NEAR(flow.pressure(Vec3(-1, -1, -1)), density * 4 / 16 * 6, 1e-14);
}

TEST(Abc, hasItsValuesAndVorticityKTimesVelocity) {
    const FlowState flow = resolved("{type: abc, A: 1 m/s, B: 0.7 m/s, C: 0.4 m/s}");
    const double x = 0.3, y = 0.5, z = 0.2;
    const Vec3 u = flow.velocity(Vec3(x - 1, y - 1, z - 1));
    EXPECT_NEAR(u[0], std::sin(k * z) + 0.4 * std::cos(k * y), 1e-14);
    EXPECT_NEAR(u[1], 0.7 * std::sin(k * x) + std::cos(k * z), 1e-14);
    EXPECT_NEAR(u[2], 0.4 * std::sin(k * y) + 0.7 * std::cos(k * x), 1e-14);
    for (const Vec3& p : places()) {
        const Mat3 G = gradient(flow, p);
        const Vec3 curl(G(2, 1) - G(1, 2), G(0, 2) - G(2, 0), G(1, 0) - G(0, 1));
        EXPECT_LT((curl - k * flow.velocity(p)).norm(), 1e-5 * k);
    }
}

TEST(PeriodicFlow, refusesABoxThatIsNoCube) {
    for (const char* text :
         {"{type: abc, A: 1 m/s, B: 1 m/s, C: 1 m/s}", "{type: taylorGreen, speed: 2 m/s, dimensions: 3}"})
        try {
            resolved(text, {L, 0.5 * L, L});
            FAIL() << text;
        } catch (const CaseError& error) {
            const std::string what = error.problems().front().message;
            EXPECT_NE(what.find("as long along x as along y and z"), std::string::npos) << what;
            EXPECT_NE(what.find("2 m, 1 m, 2 m"), std::string::npos) << what;
        }
    resolved("{type: taylorGreen, speed: 2 m/s}", {L, 0.5 * L, L});
}
