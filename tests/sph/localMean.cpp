#include "sph/localMean.hpp"

#include <gtest/gtest.h>

#include "sph/samples.hpp"

using namespace corpuscle;
using namespace corpuscle::sph;
using namespace corpuscle::sph::testing;

namespace {

constexpr Index3 size{7, 6, 6};
constexpr double support = 2.3;

struct Sample {
    std::vector<Particle> all = lattice(size, 0.2);
    ParticleSystem system;

    explicit Sample(Precision precision)
        : system(MPI_COMM_WORLD, cube(size), {.mass = true, .side = true}, support, 0.3, 1, precision) {
        for (Particle& p : all) p.wall = p.x[0] < 1.5;
        deal(all, system);
        ParticleStore& s = system.store();
        for (std::size_t i = 0; i < s.size(); ++i) s.side[i] = side(all[static_cast<std::size_t>(s.id[i])]);
    }
    static int side(const Particle& p) { return p.x[2] > 3 ? 2 : 0; }
    static double field(const Particle& p) { return 1e5 * (p.u[0] + p.x[1]); }

    std::vector<double> values(double (*of)(const Particle&)) const {
        std::vector<double> found;
        for (const std::int64_t id : system.store().id) found.push_back(of(all[static_cast<std::size_t>(id)]));
        return found;
    }
};

}  // namespace

TEST(LocalMean, followsItsEquationOnEachSide) {
    for (const char* name : {"wendlandC2", "lucy", "quintic"})
        for (const Precision precision : {Precision::full, Precision::mixed}) {
            Sample f(precision);
            const auto kernel = choose<Kernel>(name);
            const std::vector<double> means = localMean(f.system, *kernel, 1, f.values(&Sample::field));
            ASSERT_EQ(means.size(), static_cast<std::size_t>(f.system.owned()));
            for (std::size_t i = 0; i < means.size(); ++i) {
                const Particle& own = f.all[static_cast<std::size_t>(f.system.store().id[i])];
                double sum = 0, weights = 0;
                for (const Particle& o : f.all)
                    for (int image = 0; image < 27; ++image) {
                        if (o.wall || Sample::side(o) != Sample::side(own)) continue;
                        const Vec3 at(image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1);
                        const double r = (own.x - o.x - at.cwiseProduct(f.system.box().size())).norm();
                        if (r >= support) continue;
                        const double w = o.mass / o.density * kernel->value(r / support);
                        sum += w * Sample::field(o), weights += w;
                    }
                EXPECT_NEAR(means[i], own.wall ? Sample::field(own) : sum / weights, 1e-7) << name;
            }
        }
}

TEST(LocalMean, keepsWhatIsUniformOnASide) {
    Sample f(Precision::full);
    const auto ofSide = [](const Particle& p) { return p.wall ? 1e9 : 3.0 * Sample::side(p) + 1; };
    const std::vector<double> values = f.values(ofSide);
    const std::vector<double> means = localMean(f.system, *choose<Kernel>("wendlandC2"), 1, values);
    for (std::size_t i = 0; i < means.size(); ++i) EXPECT_NEAR(means[i] / values[i], 1, 1e-14);
}
