// The step limit for springs with drag, compared with the equation that it solves, by bisection.
#include "sph/stepLimits.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace corpuscle::sph {
namespace {

// The dt > 0 with (omega dt/2)^2 + lambda dt = 1.
double byBisection(double lambda, double omega2) {
    long double low = 0, high = 1;
    const auto excess = [&](long double dt) { return 0.25L * omega2 * dt * dt + lambda * dt - 1; };
    while (excess(high) < 0) high *= 2;
    for (int k = 0; k < 400; ++k) {
        const long double middle = 0.5L * (low + high);
        (excess(middle) < 0 ? low : high) = middle;
    }
    return static_cast<double>(low);
}

TEST(StepLimits, SpringSolvesItsEquationForAnyDrag) {
    for (const double lambda : {0.0, 1e-12, 1e-3, 1.0, 1e3, 1e9, 1e15, 1e30})
        for (const double omega2 : {1e-6, 1.0, 1e6, 1e20}) {
            const double dt = springStep(lambda, omega2);
            EXPECT_NEAR(dt, byBisection(lambda, omega2), 1e-12 * dt) << lambda << " " << omega2;
        }
}

TEST(StepLimits, SpringHasTheTwoWellKnownLimits) {
    EXPECT_DOUBLE_EQ(springStep(0, 16), 0.5);  // 2/omega
    EXPECT_DOUBLE_EQ(springStep(1e8, 0), 1e-8);
}

}  // namespace
}  // namespace corpuscle::sph
