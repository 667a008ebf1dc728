// Length of the next step: the error of many cells that limits it, and the solver's tolerance in short steps. Lengths
// in spacings, density 1.
#include "implicit/stepControl.hpp"

#include <gtest/gtest.h>

#include "coupling/sphereScene.hpp"
#include "implicit/implicitStep.hpp"

using namespace corpuscle;
using implicit::ImplicitStep;

namespace {

// 27 spheres; node 0 of the first `moved` of them is faster by `speed`.
double differenceOf(std::size_t moved, double speed) {
    std::vector<Vec3> centres;
    for (const int x : {3, 9, 15})
        for (const int y : {3, 9, 15})
            for (const int z : {3, 9, 15}) centres.emplace_back(x, y, z);
    coupling::Scene scene =
        coupling::testing::SphereScene({18, 18, 18}, centres, true).immersedScene(0.02, [](const Vec3& d) {
            return d;
        });
    ImplicitStep::Options options;
    options.settings = {.step = 1, .error = 1};
    const auto step = ImplicitStep::make(scene, options);
    step->advance(1);
    const coupling::Immersed& immersed = *step->immersed();
    const coupling::Immersed::Vectors before(immersed.layout().nodes(), Vec3::Zero());
    coupling::Immersed::Vectors after = before;
    for (std::size_t c = 0; c < immersed.layout().cells(); ++c)
        if (immersed.cells()[c].membrane.cell <= static_cast<int>(moved))
            after[immersed.layout().first(c)] = Vec3(0, speed, 0);
    return implicit::differenceOfCells(immersed, MPI_COMM_WORLD, after, before);
}

}  // namespace

TEST(StepControl, takesTheRootMeanSquareOfCellsAndAQuarterOfTheWorst) {
    // The spheres are meshes, whose volume is 0.978 of the ball's.
    const double one = differenceOf(27, 1);
    EXPECT_NEAR(one, 1 / coupling::testing::radius, 0.02 / coupling::testing::radius);
    EXPECT_NEAR(differenceOf(3, 1), one / 3, 1e-12);
    EXPECT_NEAR(differenceOf(1, 1), one / 4, 1e-12);  // root mean square: one / 5.2
    EXPECT_EQ(differenceOf(0, 1), 0);
}

TEST(StepControl, tightensTheToleranceOfShortSteps) {
    const implicit::ImplicitSettings settings{.step = 0.1};
    EXPECT_DOUBLE_EQ(implicit::toleranceShare(settings, 40, 0.1 / 40), 1);
    EXPECT_DOUBLE_EQ(implicit::toleranceShare(settings, 40, 0.05 / 40), 0.25);
    EXPECT_DOUBLE_EQ(implicit::toleranceShare(settings, 40, 0.2 / 40), 1);
    EXPECT_DOUBLE_EQ(implicit::toleranceShare(settings, 40, 1e-6), 0.01);
}
