// RKL2 for du/dt = M u with matrices whose exponentials are known.
#include "sph/legendreStages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace corpuscle::sph;

namespace {

using Vector = std::vector<double>;
constexpr double pi = std::numbers::pi;

// One step by the formulas of the header. apply: u -> M u.
template <class Apply>
Vector step(const Vector& u, double dt, int count, Apply&& apply) {
    const LegendreStages stages(count);
    const std::size_t n = u.size();
    const Vector start = apply(u);
    Vector before(n, 0.0), d(n), Y(n);
    for (std::size_t i = 0; i < n; ++i) d[i] = stages.first() * dt * start[i];
    for (const auto& stage : stages.later()) {
        for (std::size_t i = 0; i < n; ++i) Y[i] = u[i] + d[i];
        const Vector rate = apply(Y);
        for (std::size_t i = 0; i < n; ++i) {
            const double next =
                stage.last * d[i] + stage.before * before[i] + dt * (stage.rate * rate[i] + stage.startRate * start[i]);
            before[i] = d[i], d[i] = next;
        }
    }
    for (std::size_t i = 0; i < n; ++i) Y[i] = u[i] + d[i];
    return Y;
}

// The factor by which a step multiplies a mode of rate -lambda.
double factor(double lambdaDt, int count) {
    return step({1.0}, 1, count, [&](const Vector& u) { return Vector{-lambdaDt * u[0]}; })[0];
}

// Diffusion between walls at 0: (M u)_i = n^2 (u_(i-1) - 2 u_i + u_(i+1)) at i/n, whose modes sin(k pi x) have the
// rates 4 n^2 sin^2(k pi/2n).
struct Diffusion {
    int n = 40;
    double rate(int k) const { return 4.0 * n * n * std::pow(std::sin(k * pi / (2 * n)), 2); }
    Vector apply(const Vector& u) const {
        Vector result(u.size());
        for (std::size_t i = 0; i < u.size(); ++i)
            result[i] = n * n * ((i > 0 ? u[i - 1] : 0) - 2 * u[i] + (i + 1 < u.size() ? u[i + 1] : 0));
        return result;
    }
    Vector modes(double t, std::initializer_list<int> which) const {
        Vector u(static_cast<std::size_t>(n - 1), 0.0);
        for (const int k : which)
            for (int i = 1; i < n; ++i)
                u[static_cast<std::size_t>(i - 1)] += std::sin(k * pi * i / n) * std::exp(-rate(k) * t);
        return u;
    }
    Vector run(Vector u, double time, int steps, int count) const {
        for (int k = 0; k < steps; ++k) u = step(u, time / steps, count, [&](const Vector& v) { return apply(v); });
        return u;
    }
};

double largest(const Vector& u) {
    double most = 0;
    for (const double v : u) most = std::max(most, std::abs(v));
    return most;
}
double distance(Vector a, const Vector& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
    return largest(a);
}

}  // namespace

TEST(LegendreStages, multiplyByLegendresPolynomial) {
    for (const int s : {3, 4, 5, 9, 15, 31})
        for (const double part : {0.0, 0.01, 0.3, 0.77, 1.0}) {
            const double z = part * LegendreStages::reach(s), b = (s * s + s - 2.0) / (2.0 * s * (s + 1)),
                         x = 1 - 4 * z / (s * s + s - 2.0);
            EXPECT_NEAR(factor(z, s), 1 - b + b * std::legendre(static_cast<unsigned>(s), x), 1e-12)
                << s << ' ' << part;
        }
}

TEST(LegendreStages, coefficientsOfThreeStagesAsPublished) {  // w = 2/5
    const LegendreStages three(3);
    ASSERT_EQ(three.count(), 3);
    EXPECT_NEAR(three.first(), 2.0 / 15, 1e-15);
    const auto &second = three.later()[0], &third = three.later()[1];
    EXPECT_NEAR(second.last, 1.5, 1e-15);
    EXPECT_NEAR(second.before, -0.5, 1e-15);
    EXPECT_NEAR(second.rate, 0.6, 1e-15);
    EXPECT_NEAR(second.startRate, -0.4, 1e-15);
    EXPECT_NEAR(third.last, 25.0 / 12, 1e-15);  // b_3 = 5/12
    EXPECT_NEAR(third.before, -5.0 / 6, 1e-15);
    EXPECT_NEAR(third.rate, 5.0 / 6, 1e-15);
    EXPECT_NEAR(third.startRate, -5.0 / 9, 1e-15);
}

TEST(LegendreStages, agreeWithTheExponentialToSecondOrder) {
    for (const int s : {3, 9, 21}) {
        const double z = 1e-3;
        EXPECT_NEAR(factor(z, s), 1 - z + 0.5 * z * z, 0.2 * z * z * z) << s;
    }
}

TEST(LegendreStages, areStableToTheirReachAndNotBeyond) {
    for (const int s : {3, 5, 9, 15, 31}) {
        const double reach = LegendreStages::reach(s);
        for (int k = 1; k <= 1000; ++k) {
            EXPECT_LT(factor(k * reach / 1000, s), 1) << s;
            EXPECT_GT(factor(k * reach / 1000, s), 0) << s;
        }
        EXPECT_NEAR(factor(reach, s), 2.0 / (s * s + s), 1e-9);
        EXPECT_LT(factor(1.3 * reach, s), -1) << s;
    }
    EXPECT_NEAR(factor(LegendreStages::reach(4), 4), 1, 1e-12) << "an even number does not damp";
}

TEST(LegendreStages, theFewestThatReachAreTaken) {
    EXPECT_EQ(LegendreStages::needed(0), 3);
    EXPECT_EQ(LegendreStages::needed(5), 3);
    EXPECT_EQ(LegendreStages::needed(5.001), 5);
    EXPECT_EQ(LegendreStages::needed(119), 15);
    EXPECT_EQ(LegendreStages::needed(119.1), 17);
}

TEST(LegendreStages, diffusionConvergesToItsSolutionWithSecondOrder) {
    const Diffusion diffusion;
    const double time = 0.1;
    const Vector exact = diffusion.modes(time, {1, 2});
    for (const int s : {9, 15}) {
        const int steps = static_cast<int>(std::ceil(time * diffusion.rate(39) / LegendreStages::reach(s)));
        const auto error = [&](int n) {
            return distance(diffusion.run(diffusion.modes(0, {1, 2}), time, n, s), exact);
        };
        EXPECT_LT(error(steps), 0.01 * largest(exact)) << s;
        EXPECT_NEAR(std::log2(error(4 * steps) / error(8 * steps)), 2, 0.1) << s;
        EXPECT_NEAR(std::log2(error(8 * steps) / error(16 * steps)), 2, 0.05) << s;
    }
}

TEST(LegendreStages, diffusionIsStableToTheLimitAndNotBeyond) {
    const Diffusion diffusion;
    const Vector rough = diffusion.modes(0, {1, 7, 20, 33, 38, 39});
    for (const int s : {5, 11}) {
        const double dt = LegendreStages::reach(s) / diffusion.rate(39);
        EXPECT_LT(largest(diffusion.run(rough, 200 * dt, 200, s)), largest(diffusion.run(rough, 100 * dt, 100, s)));
        EXPECT_LT(largest(diffusion.run(rough, 100 * dt, 100, s)), 0.1 * largest(rough));
        EXPECT_GT(largest(diffusion.run(rough, 26 * dt, 20, s)), 1e3 * largest(rough));
    }
}
