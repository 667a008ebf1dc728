// Weights of the nodes of a flat membrane between two fluids. References: the exact flow, and
// benchmarks/placement/plane.py (-weights kink -mean laminate -R 2), an independent program of the same model.
#include "coupling/flatMembrane.hpp"

#include <gtest/gtest.h>

#include "sph/samples.hpp"

using namespace corpuscle;
using namespace corpuscle::coupling;

namespace {

FlatMembrane between(double ratio) { return {*sph::testing::model("wendlandC2").kernel, 2.4, 2, ratio}; }

}  // namespace

TEST(FlatMembrane, conditionsAreThoseOfTheOtherProgram) {
    const struct {
        double ratio, kink, slope;
    } references[] = {{1, 0.1624, 0}, {2, 0.2010, -0.0876}, {5, 0.2791, -0.1915}};
    for (const auto& [ratio, kink, slope] : references) {
        const NodeConditions found = between(ratio).conditions(0);
        EXPECT_NEAR(found.kink, kink, 5e-4) << ratio;
        EXPECT_NEAR(found.slope, slope, 5e-4) << ratio;
    }
}

TEST(FlatMembrane, nodesMoveAsInTheExactFlow) {
    for (const double ratio : {0.2, 0.5, 1.0, 2.0, 5.0, 20.0, 100.0}) {
        const FlatMembrane plane = between(ratio);
        const NodeConditions conditions = plane.conditions();
        const FlatMembrane::Errors mean = plane.meanErrors(conditions), without = plane.meanErrors({.kink = 0.05});
        EXPECT_NEAR(mean.self, FlatMembrane::selfAmongLayers, ratio > 9 ? 0.08 : 1e-10) << ratio;
        EXPECT_NEAR(mean.cross, 0, 1e-10) << ratio;
        EXPECT_GT(std::abs(without.self), 0.02) << ratio;
    }
}

// Errors are largest for a membrane on a layer of particles, and halfway between two (plane.py: from -0.0167 to
// +0.0151).
TEST(FlatMembrane, placeBetweenLayersChangesLittle) {
    const FlatMembrane plane = between(1);
    const NodeConditions conditions = plane.conditions(0);
    double least = 1, most = -1;
    for (int k = 0; k < sph::ViscousLayers::places; ++k) {
        const double self = plane.errors(k, conditions).self;
        least = std::min(least, self), most = std::max(most, self);
    }
    EXPECT_NEAR(least, -0.0167, 5e-4);
    EXPECT_NEAR(most, 0.0151, 5e-4);
}
