// Diffusion of a solute: against the sum written out, kept to rounding, and a wave against its exact decay.
#include "sph/diffusion.hpp"

#include <gtest/gtest.h>

#include "core/communicator.hpp"
#include "sph/samples.hpp"

using namespace corpuscle;
using namespace corpuscle::sph;
using namespace corpuscle::sph::testing;

namespace {

constexpr double support = 2.3, D = 0.4;

FluidModel carrier(const std::string& kernel) {
    FluidModel m = model(kernel);
    m.solute = Solute{.diffusivity = D};
    return m;
}

}  // namespace

TEST(Diffusion, followsItsEquationOnEachSide) {
    constexpr Index3 size{7, 6, 6};
    for (const char* name : {"wendlandC2", "lucy", "quintic"})
        for (const Precision precision : {Precision::full, Precision::mixed}) {
            std::vector<Particle> all = lattice(size, 0.2);
            for (Particle& p : all) p.wall = p.x[0] < 1.5;
            ParticleSystem system(MPI_COMM_WORLD, cube(size), {.mass = true, .side = true}, support, 0.3, 1, precision);
            deal(all, system);
            ParticleStore& s = system.store();
            const auto side = [](const Particle& p) { return p.x[2] > 3 ? 2 : 0; };
            const auto field = [](const Particle& p) { return 3 + p.u[0] + p.x[1]; };
            std::vector<double> c;
            for (std::size_t i = 0; i < s.size(); ++i) {
                const Particle& p = all[static_cast<std::size_t>(s.id[i])];
                s.side[i] = side(p), c.push_back(field(p));
            }
            const FluidModel fluid = carrier(name);
            Diffusion diffusion(fluid, system);
            diffusion.find(system, c);
            const double k = 2 * D / fluid.kernel->secondMoment(support);
            double sum = 0, size2 = 0;
            for (std::size_t i = 0; i < s.size(); ++i) {
                const Particle& own = all[static_cast<std::size_t>(s.id[i])];
                double rate = 0, speed = 0;
                for (const Particle& o : all)
                    for (int image = 0; image < 27; ++image) {
                        if (own.wall || o.wall || side(o) != side(own)) continue;
                        const int plane = image / 9, line = image / 3 % 3;
                        const Vec3 at(image % 3 - 1, line - 1, plane - 1);
                        const double r = (own.x - o.x - at.cwiseProduct(system.box().size())).norm();
                        if (r >= support || r == 0) continue;
                        const double F =
                            fluid.kernel->gradientNormalisation(support) * fluid.kernel->slope(r / support);
                        rate += k * own.mass * o.mass * F * (field(o) - field(own)), speed += k * o.mass * F;
                    }
                EXPECT_NEAR(diffusion.rates()[i], rate, 1e-6) << name;
                EXPECT_NEAR(diffusion.speeds()[i], speed, 1e-6) << name;
                sum += diffusion.rates()[i], size2 += std::abs(diffusion.rates()[i]);
            }
            const Communicator ranks;
            EXPECT_LT(std::abs(ranks.sum(sum)), 1e-13 * ranks.sum(size2)) << name;
        }
}

// c = cos k x decays at the rate D k^2; the error is of second order in the support.
TEST(Diffusion, wavesDecayAsTheyShould) {
    double errors[2];
    for (int level = 0; level < 2; ++level) {
        const int n = level == 0 ? 12 : 24;
        const Index3 size{n, 6, 6};
        ParticleSystem system(MPI_COMM_WORLD, cube(size), {}, 2.4, 0.3, 1);
        deal(lattice(size, 0), system);
        const ParticleStore& s = system.store();
        const double k = 2 * std::numbers::pi / n;
        std::vector<double> c;
        for (std::size_t i = 0; i < s.size(); ++i) c.push_back(1 + std::cos(k * s.x[i]));
        Diffusion diffusion(carrier("wendlandC2"), system);
        diffusion.find(system, c);
        double product = 0, square = 0;
        for (std::size_t i = 0; i < s.size(); ++i) {
            const double wave = std::cos(k * s.x[i]);
            product += diffusion.rates()[i] * wave, square += wave * wave;
        }
        const Communicator ranks;
        errors[level] = 1 + ranks.sum(product) / ranks.sum(square) / (D * k * k);
    }
    EXPECT_LT(std::abs(errors[1]), 0.01);
    EXPECT_NEAR(errors[0] / errors[1], 4, 0.3);
}
