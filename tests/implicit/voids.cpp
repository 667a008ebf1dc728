// A void between particles: the continuity equation leaves it; densities that follow the number of particles close it,
// and so does a background pressure. Lengths in spacings, density 1.
#include <gtest/gtest.h>

#include <array>

#include "coupling/fluidScene.hpp"
#include "implicit/implicitStep.hpp"

using namespace corpuscle;
using coupling::testing::FluidScene;
using implicit::ImplicitStep;

namespace {

constexpr double rate = 1, strainOfStep = 0.05, hole = 1.8;
const Index3 size{12, 12, 12};

sph::FluidModel viscous() {
    sph::FluidModel m = sph::testing::model("wendlandC2", "linear");
    m.viscosity = 100, m.soundSpeed = 230;  // no inertia; bulk modulus 500 mu rate
    return m;
}

// Fluid at rest around the hole, without shifting.
struct Void : FluidScene {
    std::unique_ptr<ImplicitStep> step;
    explicit Void(double densityRate, double backgroundPressure = 0)
        : FluidScene(coupling::testing::withHole(size, hole), size, viscous(), rate, 0, MPI_COMM_WORLD,
                     particles::Precision::full) {
        ImplicitStep::Options options;
        options.settings = {.step = strainOfStep, .tolerance = 1e-6};
        options.densityRate = densityRate, options.backgroundPressure = backgroundPressure;
        step = ImplicitStep::make(scene, options);
    }
    void run(int steps) {
        for (int k = 0; k < steps; ++k) step->advance(strainOfStep / rate);
    }
    // Least and largest sum_j V_j W of any particle: 1 in an even distribution.
    std::array<double, 2> evenness() {
        sph::Operators<double> operators(scene.model(), *scene.system, sph::OperatorForm::corrected);
        scene.system->rebuild();
        operators.build(*scene.system);
        double least = 1, most = -1;
        for (std::size_t i = 0; i < scene.store().size(); ++i)
            least = std::min(least, operators.evenness(i)), most = std::max(most, operators.evenness(i));
        MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
        MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
        return {least, most};
    }
};

}  // namespace

TEST(Voids, stayWhereDensitiesFollowTheContinuityEquation) {
    Void box(0);
    const double before = box.evenness()[0];
    box.run(40);
    EXPECT_LT(before, 0.8);
    EXPECT_NEAR(box.evenness()[0], before, 1e-3);
}

TEST(Voids, closeWhereDensitiesFollowTheNumberOfParticles) {
    Void box(1);
    const double before = box.evenness()[0];
    box.run(40);
    const auto [least, most] = box.evenness();
    EXPECT_GT(least, before + 0.6 * (1 - before));
    EXPECT_LT(most, 1.1);
}

// 20 mu rate; the fluid has to expand by 1.4 % to fill the void, which takes 7 mu rate.
TEST(Voids, closeUnderABackgroundPressure) {
    Void box(0, 2000);
    const double before = box.evenness()[0];
    box.run(40);
    const auto [least, most] = box.evenness();
    EXPECT_GT(least, before + 0.6 * (1 - before));
    EXPECT_LT(most, 1.1);
}

// A lattice is even: nothing moves.
TEST(Voids, areNotSeenInALattice) {
    FluidScene even(coupling::testing::still(size), size, viscous(), rate, 0, MPI_COMM_WORLD,
                    particles::Precision::full);
    ImplicitStep::Options options;
    options.settings = {.step = strainOfStep, .tolerance = 1e-6};
    options.densityRate = 1, options.backgroundPressure = 2000;
    const auto step = ImplicitStep::make(even.scene, options);
    for (int k = 0; k < 5; ++k) step->advance(strainOfStep / rate);
    double fastest = 0;
    for (std::size_t i = 0; i < even.scene.store().size(); ++i)
        fastest = std::max(fastest, even.scene.store().velocity(i).norm());
    MPI_Allreduce(MPI_IN_PLACE, &fastest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    EXPECT_LT(fastest, 1e-9);
}
