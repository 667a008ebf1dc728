// A stiff membrane, pulled out of shape in fluid at rest, with steps far longer than its relaxation time: the
// deformation that the midpoint rule leaves changes its sign from step to step, and must vanish within a few steps.
// Lengths in spacings, density 1.
#include <gtest/gtest.h>

#include <algorithm>

#include "coupling/sphereScene.hpp"
#include "implicit/implicitStep.hpp"

using namespace corpuscle;
using implicit::ImplicitStep;

namespace {

coupling::Scene pulledSphere(double stretch) {
    return coupling::testing::SphereScene({10, 10, 10}, {Vec3(5, 5, 5)}, true).immersedScene(0.02, [&](const Vec3& d) {
        return Vec3((1 + 2 * stretch) * d[0], (1 - stretch) * d[1], (1 - stretch) * d[2]);
    });
}

}  // namespace

TEST(Ringing, ofAStiffMembraneDiesAway) {
    coupling::Scene scene = pulledSphere(0.01);
    ImplicitStep::Options options;
    options.settings = {.step = 1, .tolerance = 1e-8, .error = 1, .bondStrain = 1};
    const auto step = ImplicitStep::make(scene, options);
    const auto energy = [&] { return scene.cells[0].membrane.energy(); };
    const double atFirst = energy();
    for (int k = 0; k < 7; ++k) step->advance(100);
    EXPECT_LT(energy(), 0.01 * atFirst);  // 0.0023; by the plain midpoint rule 0.21
    EXPECT_EQ(step->statistics.halvings, 0);
}

// The error of a step is estimated from the change of velocities. A displacement that changes its sign makes this
// change the larger, the shorter the step: if steps shrink faster than the ringing decays, they stay short.
TEST(Ringing, letsShortenedStepsGrowAgain) {
    coupling::Scene scene = pulledSphere(0.01);
    ImplicitStep::Options options;
    options.settings = {.step = 1, .tolerance = 1e-8, .error = 1e-4, .bondStrain = 1};
    const auto step = ImplicitStep::make(scene, options);
    constexpr double longest = 100;
    double dt = longest, shortest = longest;
    for (int k = 0; k < 22; ++k) {
        step->advance(dt);
        const double allowed = step->allowed().error;
        dt = allowed > 0 ? std::min(longest, allowed) : longest;
        shortest = std::min(shortest, dt);
    }
    EXPECT_LT(shortest, 0.1 * longest);
    EXPECT_GT(dt, 0.9 * longest);  // with steps of at least a fifth of the one before: 0.02
}
