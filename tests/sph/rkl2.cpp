#include "sph/rkl2.hpp"

#include <gtest/gtest.h>

#include "sph/swirl.hpp"
#include "sph/velocityVerlet.hpp"

using namespace corpuscle;
using namespace corpuscle::sph;
using namespace corpuscle::sph::testing;

namespace {

using swirl::difference;

struct Box3 {
    FluidModel fluid;
    ParticleSystem system;
    std::unique_ptr<FluidForces> forces;

    explicit Box3(const std::string& equationOfState = "linear", MPI_Comm comm = MPI_COMM_WORLD,
                  Precision precision = Precision::full)
        : fluid(model("wendlandC2", equationOfState)), system(comm, cube(swirl::size), {}, 2.5, 0.3, 1, precision) {
        fluid.viscosity = 0.1;
        deal(swirl::particles(), system);
        forces = std::make_unique<FluidForces>(fluid, system);
    }
    std::vector<double> run(double time, int steps, int stages) {
        Rkl2 integrator(system, *forces, nullptr);
        integrator.start();
        integrator.setRate(LegendreStages::reach(stages) / (time / steps) * (1 - 1e-12));
        EXPECT_EQ(integrator.stages(time / steps), stages);
        for (int k = 0; k < steps; ++k) integrator.advance(time / steps);
        return swirl::state(system);
    }
};

double energy(const ParticleSystem& system) {
    double sum = 0;
    for (std::size_t i = 0; i < system.store().size(); ++i) sum += system.store().velocity(i).squaredNorm();
    return sumOverRanks(sum);
}

}  // namespace

TEST(Rkl2, isOfSecondOrderWhateverTheStages) {
    for (const int stages : {3, 9}) {
        const auto coarse = Box3().run(0.4, 20, stages), middle = Box3().run(0.4, 40, stages),
                   fine = Box3().run(0.4, 80, stages);
        const double ratio = difference(coarse, middle) / difference(middle, fine);
        EXPECT_GT(ratio, 3.6) << stages;
        EXPECT_LT(ratio, 4.4) << stages;
    }
}

TEST(Rkl2, agreesWithVelocityVerlet) {
    Box3 box;
    VelocityVerlet verlet(box.system, *box.forces, nullptr, {});
    verlet.start();
    for (int k = 0; k < 160; ++k) verlet.advance(0.4 / 160);
    const auto other = swirl::state(box.system);
    EXPECT_GT(box.system.rebuilds(), 1);
    EXPECT_LT(difference(Box3().run(0.4, 80, 5), other), 0.5 * difference(Box3().run(0.4, 40, 5), other));
    EXPECT_LT(difference(Box3().run(0.4, 80, 5), other), 2e-3);
}

TEST(Rkl2, repeatsBitForBit) { EXPECT_EQ(Box3().run(0.4, 25, 7), Box3().run(0.4, 25, 7)); }

TEST(Rkl2, isTheSameOnOneRankAndOnAll) {
    for (const Precision precision : {Precision::full, Precision::mixed}) {
        const auto alone = Box3("tait", MPI_COMM_SELF, precision).run(0.4, 20, 7),
                   shared = Box3("tait", MPI_COMM_WORLD, precision).run(0.4, 20, 7);
        EXPECT_LT(difference(alone, shared), precision == Precision::full ? 1e-11 : 1e-4);
    }
}

// One step written out from the header, with forces from another FluidForces.
TEST(Rkl2, aStepFollowsTheEquations) {
    const double dt = 0.04;
    Box3 stepped, plain;
    Rkl2 integrator(stepped.system, *stepped.forces, nullptr);
    integrator.start();
    integrator.setRate(LegendreStages::reach(5) / dt);
    integrator.advance(dt);

    ParticleStore& s = plain.system.store();
    FluidForces& forces = *plain.forces;
    forces.evaluate(plain.system, 0);
    const ParticleStore old = s;
    const std::size_t n = s.size();
    const auto acceleration = [&](std::size_t i) { return Vec3(s.fx[i], s.fy[i], s.fz[i]); };
    for (std::size_t i = 0; i < n; ++i) {
        s.setPosition(i, old.position(i) + 0.5 * dt * old.velocity(i));
        s.density[i] = old.density[i] + 0.5 * dt * old.densityRate[i];
    }
    forces.evaluate(plain.system, 0);
    const ParticleStore middle = s;
    std::vector<Vec3> start(n), before(n, Vec3::Zero()), d(n);
    const LegendreStages stages(5);
    for (std::size_t i = 0; i < n; ++i) start[i] = acceleration(i), d[i] = stages.first() * dt * start[i];
    for (const auto& stage : stages.later()) {
        for (std::size_t i = 0; i < n; ++i) s.setVelocity(i, old.velocity(i) + d[i]);
        forces.evaluate(plain.system, 0);
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 next = stage.last * d[i] + stage.before * before[i] +
                              dt * (stage.rate * acceleration(i) + stage.startRate * start[i]);
            before[i] = d[i], d[i] = next;
        }
    }
    for (std::size_t i = 0; i < n; ++i) s.setVelocity(i, old.velocity(i) + d[i]);
    forces.evaluate(plain.system, 0);
    const ParticleStore& t = stepped.system.store();
    ASSERT_EQ(t.id, s.id);
    for (std::size_t i = 0; i < n; ++i) {
        EXPECT_LT((t.velocity(i) - s.velocity(i)).norm(), 1e-13);
        EXPECT_LT((t.position(i) - (s.position(i) + 0.5 * dt * s.velocity(i))).norm(), 1e-13);
        EXPECT_NEAR(t.density[i], old.density[i] + 0.5 * dt * (middle.densityRate[i] + s.densityRate[i]), 1e-13);
    }
}

// Velocity noise, which contains the stiffest modes of the viscous operator, decays at the limit and grows beyond it.
TEST(Rkl2, isStableToTheLimitAndNotBeyond) {
    for (const double beyond : {1.0, 1.3}) {
        std::vector<Particle> all = lattice({8, 8, 8}, 0.1, 5);
        for (Particle& p : all) p.u *= 1e-6, p.density = 1;
        ParticleSystem system(MPI_COMM_WORLD, cube({8, 8, 8}), {}, 2.5, 0.3, 1);
        deal(all, system);
        FluidModel fluid = model("wendlandC2");
        fluid.soundSpeed = 1e-6;  // only viscosity matters
        FluidForces forces(fluid, system);
        Rkl2 integrator(system, forces, nullptr);
        integrator.start();
        const double rate = 1.03 * forces.viscousRate(system, 25), dt = LegendreStages::reach(9) / rate,
                     first = energy(system);
        integrator.setRate((1 - 1e-12) * rate / beyond);
        EXPECT_EQ(integrator.stages(dt * beyond), 9);
        for (int k = 0; k < 12; ++k) integrator.advance(dt * beyond);
        if (beyond == 1)
            EXPECT_LT(energy(system), 0.2 * first);
        else
            EXPECT_GT(energy(system), 1e3 * first);
    }
}

TEST(Rkl2, wallsFeelTheFluidAndKeepTheirVelocity) {
    const Index3 n{4, 4, 14};
    FluidModel fluid = model("wendlandC2");
    fluid.walls = boundary::testing::planes(2, 3, 11, Vec3(-0.01, 0, 0), Vec3(0.01, 0, 0));
    std::vector<Particle> all = lattice(n, 0);
    for (Particle& p : all) {
        p.density = 1, p.wall = p.x[2] < 3 || p.x[2] > 11;
        p.u = Vec3(p.wall ? (p.x[2] < 3 ? -0.01 : 0.01) : 0.0025 * (p.x[2] - 7), 0, 0);
    }
    ParticleSystem system(MPI_COMM_WORLD, cube(n, true), {}, 2.5, 0.3, 1);
    deal(all, system);
    FluidForces forces(fluid, system);
    Rkl2 integrator(system, forces, nullptr);
    integrator.start();
    integrator.setRate(forces.viscousRate(system, 25));
    for (int k = 0; k < 30; ++k) integrator.advance(0.25);
    const ParticleStore& s = system.store();
    for (std::size_t i = 0; i < s.size(); ++i) {
        const bool wall = s.kindOf(i) == Kind::wall;
        EXPECT_NEAR(s.u[i], wall ? std::copysign(0.01, s.z[i] - 7) : 0.0025 * (s.z[i] - 7), wall ? 0 : 2e-4);
    }
    EXPECT_NEAR(sumOverRanks(forces.wallForces()[1][0]), -0.7 * 0.0025 * 16, 0.03 * 0.7 * 0.0025 * 16);
}
