#include "sph/modelName.hpp"

#include <gtest/gtest.h>

#include "sph/kernel.hpp"

namespace corpuscle::sph {
namespace {

Choice<Kernel> kernel() {
    Problems problems;
    auto chosen = readChoice<Kernel>(parseValue("modelName", "test", problems), problems);
    problems.throwIfAny();
    return chosen;
}

TEST(ModelName, isAKernel) {
    const auto w = kernel();
    EXPECT_EQ(w->kind(), Kernels::kindOf<ModelName>());
    const double H = 2, dr = 1e-4;
    double integral = 0;
    for (double r = 0.5 * dr; r < H; r += dr) integral += 4 * std::numbers::pi * r * r * dr * w->value(r / H);
    EXPECT_NEAR(integral * w->normalisation(H), 1, 1e-6);
    for (const double r : {0.3, 1.0, 1.7}) {
        const double slope = (w->value((r + dr) / H) - w->value((r - dr) / H)) / (2 * dr) * w->normalisation(H);
        EXPECT_NEAR(w->gradientNormalisation(H) * w->slope(r / H), -slope / r, 1e-6) << r;
    }
    EXPECT_EQ(w->value(1), 0);
    EXPECT_EQ(w->slope(1.1), 0);
}

// The support is chosen by the error of the viscosity on a lattice.
TEST(ModelName, secondMomentAtItsSupport) { EXPECT_NEAR(kernel()->secondMoment(ModelName::defaultSupport), 1, 0.05); }

TEST(ModelName, isInEveryPairLoop) {
    for (const bool atWall : {false, true}) {
        FluidVariant variant;
        variant.kernel = Kernels::kindOf<ModelName>();
        EXPECT_NE(pairKernels().fluid(variant, atWall).run, nullptr);
        EXPECT_NE(pairKernels().fluidFloat(variant, atWall).run, nullptr);
    }
}

}  // namespace
}  // namespace corpuscle::sph
