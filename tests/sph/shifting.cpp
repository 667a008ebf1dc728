#include "sph/shifting.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sph/samples.hpp"

using namespace corpuscle;
using namespace corpuscle::sph;
using namespace corpuscle::sph::testing;

namespace {
constexpr Index3 size{7, 6, 6};
constexpr double support = 2.3;
}  // namespace

TEST(Shifting, followsTheEquationAndItsBound) {
    const auto kernel = choose<Kernel>("wendlandC2");
    for (const double coefficient : {0.02, 1.0}) {
        ParticleSystem system(MPI_COMM_WORLD, cube(size), {true, false, false, false}, support, 0.3, 1);
        const std::vector<Particle> all = lattice(size, 0.2);
        deal(all, system);
        ShiftingSettings settings;
        settings.coefficient = coefficient;
        settings.steps = 5;
        const double rate = 2, dt = 0.01;
        Shifting shifting(settings, *kernel, support, rate, 1);
        shifting.apply(system, dt);
        const ParticleStore& s = system.store();
        double most = 0;
        for (std::size_t i = 0; i < s.size(); ++i) {
            Vec3 C = Vec3::Zero();
            for (const Particle& o : all)
                for (int image = 0; image < 27; ++image) {
                    const Vec3 d =
                        all[s.id[i]].x - o.x -
                        Vec3(image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1).cwiseProduct(system.box().size());
                    C += o.mass / o.density * kernel->gradientNormalisation(support) *
                         kernel->slope(d.norm() / support) * d;
                }
            Vec3 expected = coefficient * support * support * rate * dt * 5 * C;
            if (expected.norm() > 0.05) expected *= 0.05 / expected.norm();
            most = std::max(most, expected.norm());
            EXPECT_LT((system.periodicity().shortest(s.position(i) - all[s.id[i]].x) - expected).norm(), 1e-12);
        }
        EXPECT_NEAR(shifting.largest(), most, 1e-12);
    }
}

TEST(Shifting, leavesALatticeAsItIsAndIsDueEverySoManySteps) {
    ParticleSystem system(MPI_COMM_WORLD, cube(size), {}, support, 0.3, 1);
    deal(lattice(size, 0), system);
    ShiftingSettings settings;
    settings.steps = 3;
    Shifting shifting(settings, *choose<Kernel>("lucy"), support, 1, 1);
    shifting.apply(system, 1);
    EXPECT_LT(shifting.largest(), 1e-13);
    EXPECT_FALSE(shifting.due());
    EXPECT_FALSE(shifting.due());
    EXPECT_TRUE(shifting.due());
    EXPECT_FALSE(shifting.due());
}
