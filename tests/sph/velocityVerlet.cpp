#include "sph/velocityVerlet.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sph/swirl.hpp"

using namespace corpuscle;
using namespace corpuscle::sph;
using namespace corpuscle::sph::testing;

namespace {

using swirl::difference;

// The state at time 0.4.
std::vector<double> run(int steps, const std::string& kernel = "wendlandC2") {
    FluidModel fluid = model(kernel, "linear");
    fluid.viscosity = 0.1;
    ParticleSystem system(MPI_COMM_WORLD, cube(swirl::size), {}, 2.5, 0.3, 1);
    deal(swirl::particles(), system);
    FluidForces forces(fluid, system);
    VelocityVerlet integrator(system, forces, nullptr, {});
    integrator.start();
    for (int k = 0; k < steps; ++k) integrator.advance(0.4 / steps);
    EXPECT_GT(system.rebuilds(), 1);
    return swirl::state(system);
}

}  // namespace

TEST(VelocityVerlet, isOfSecondOrder) {
    const auto coarse = run(20), middle = run(40), fine = run(80);
    const double ratio = difference(coarse, middle) / difference(middle, fine);
    EXPECT_GT(ratio, 3.6);
    EXPECT_LT(ratio, 4.4);
}

TEST(VelocityVerlet, repeatsBitForBit) { EXPECT_EQ(run(25, "lucy"), run(25, "lucy")); }

// One step written out from Eqs 12 to 17 of the header, with forces from another FluidForces.
TEST(VelocityVerlet, aStepFollowsTheEquations) {
    FluidModel fluid = model("lucy");
    const double dt = 0.01;
    ParticleSystem system(MPI_COMM_WORLD, cube(swirl::size), {}, 2.3, 0.3, 1),
        plain(MPI_COMM_WORLD, cube(swirl::size), {}, 2.3, 0.3, 1);
    deal(swirl::particles(), system);
    deal(swirl::particles(), plain);
    FluidForces forces(fluid, system), plainForces(fluid, plain);
    VelocityVerlet integrator(system, forces, nullptr, {});
    integrator.start();
    integrator.advance(dt);

    ParticleStore& s = plain.store();
    plainForces.evaluate(plain, 0);
    const ParticleStore old = s;
    const std::size_t n = s.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 a(old.fx[i], old.fy[i], old.fz[i]), half = old.velocity(i) + 0.5 * dt * a;
        s.setVelocity(i, old.velocity(i) + dt * a);
        s.setPosition(i, old.position(i) + dt * half);
        s.density[i] = old.density[i] + dt * old.densityRate[i];
    }
    plainForces.evaluate(plain, 0);
    ASSERT_EQ(system.store().id, s.id);
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 a(old.fx[i], old.fy[i], old.fz[i]), b(s.fx[i], s.fy[i], s.fz[i]);
        EXPECT_LT((system.store().velocity(i) - (old.velocity(i) + 0.5 * dt * (a + b))).norm(), 1e-13);
        EXPECT_LT((system.store().position(i) - s.position(i)).norm(), 1e-13);
        EXPECT_NEAR(system.store().density[i], old.density[i] + 0.5 * dt * (old.densityRate[i] + s.densityRate[i]),
                    1e-13);
    }
}
