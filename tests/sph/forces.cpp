// Pair forces compared with a plain double loop over all pairs and images, written from the equations.
#include <gtest/gtest.h>

#include <cmath>

#include "sph/samples.hpp"

using namespace corpuscle;
using namespace corpuscle::sph;
using namespace corpuscle::sph::testing;

namespace {

constexpr double support = 2.3, skin = 0.3;

struct Case {
    const char* name;
    std::string kernel, equationOfState;
    bool varyingMass, varyingViscosity, walls;
    double extrapolation;
    Index3 size;
};

const Case cases[] = {
    {"lucy", "lucy", "tait", false, false, false, 0, {7, 6, 8}},
    {"wendland", "wendlandC2", "linear", false, false, false, 0, {7, 6, 8}},
    {"quintic", "quintic", "tait", false, false, false, 0.05, {7, 6, 8}},
    {"lucyThinBox", "lucy", "tait", false, false, false, 0, {9, 4, 2}},
    {"lucyMass", "lucy", "tait", true, false, false, 0, {7, 6, 8}},
    {"wendlandViscosity", "wendlandC2", "tait", false, true, false, 0, {7, 6, 8}},
    {"quinticBoth", "quintic", "linear", true, true, false, 0.02, {7, 6, 8}},
    {"lucyWalls", "lucy", "tait", false, false, true, 0, {6, 6, 11}},
    {"wendlandWallsMass", "wendlandC2", "tait", true, false, true, 0.02, {6, 6, 11}},
    {"quinticWallsViscosity", "quintic", "tait", false, true, true, 0, {6, 6, 11}},
    {"wendlandWallsBoth", "wendlandC2", "linear", true, true, true, 0, {6, 6, 11}},
};

// Thickness of a wall in the boxes with walls, whose surfaces do not coincide with lattice planes.
constexpr double layers = 2.6;

class Forces : public ::testing::TestWithParam<Case> {
  protected:
    FluidModel fluid;
    std::vector<Particle> all;
    std::unique_ptr<ParticleSystem> system;

    void SetUp() override {
        const Case& c = GetParam();
        fluid = model(c.kernel, c.equationOfState);
        fluid.bodyForce = Vec3(0.3, 0, -0.2);
        all = lattice(c.size, 0.25, 5);
        if (c.walls) {
            fluid.walls = boundary::testing::planes(2, layers, c.size[2] - layers, Vec3(-1, 0.2, 0), Vec3(1, 0, 0));
            for (Particle& p : all)
                if (fluid.walls.distance(p.x) < 0) p.wall = true, p.u = fluid.walls.nearest(p.x).velocity;
            all[8].wall = false;  // one fluid particle has been pushed behind a surface
        }
        build(Precision::full);
    }

    void build(Precision precision) {
        const Case& c = GetParam();
        system = std::make_unique<ParticleSystem>(
            MPI_COMM_WORLD, cube(c.size, c.walls),
            ParticleStore::Optional{c.varyingMass, c.varyingViscosity, false, false}, support, skin, 1.0, precision);
        deal(all, *system);
    }

    // Acceleration and density rate of a particle from an earlier step, with which velocity and density are
    // extrapolated.
    static double earlierRate(int id) { return 0.2 * std::sin(2.0 * id); }
    static Vec3 earlier(int id, bool wall) {
        return wall ? Vec3::Zero().eval() : Vec3(std::sin(id), std::cos(id), 0.3);
    }

    // Compares forces with the double loop; errors are relative to the largest force.
    void compare(double tolerance);

    struct Sum {
        Vec3 a = Vec3::Zero();
        double rate = 0;
    };
    Sum bruteForce(int i) const {
        const Case& c = GetParam();
        const auto extrapolated = [&](int k) {
            Particle moved = all[k];
            moved.u += c.extrapolation * earlier(k, moved.wall);
            moved.density += c.extrapolation * earlierRate(k);
            return moved;
        };
        const Particle p = extrapolated(i);
        const Vec3 size = system->box().size();
        const auto pressure = [&](const Particle& k) {
            return fluid.equationOfState->pressure(k.density, 1, fluid.soundSpeed) / (k.density * k.density);
        };
        Sum sum;
        for (int k = 0; k < static_cast<int>(all.size()); ++k) {
            const Particle o = extrapolated(k);
            if (p.wall && o.wall) continue;
            const double mass = c.varyingMass ? o.mass : fluid.mass;
            const double viscosity =
                c.varyingViscosity ? 2 * p.viscosity * o.viscosity / (p.viscosity + o.viscosity) : fluid.viscosity;
            for (int x = -2; x <= 2; ++x)
                for (int y = -2; y <= 2; ++y)
                    for (int z = c.walls ? 0 : -2; z <= (c.walls ? 0 : 2); ++z) {
                        const Vec3 at = o.x + Vec3(x, y, z).cwiseProduct(size), d = p.x - at, du = p.u - o.u;
                        const double r = d.norm();
                        if (r == 0 || r >= support) continue;
                        const Vec3 gradient = kernelDerivative(c.kernel, r, support) * d / r;
                        sum.a -= mass * (pressure(p) + pressure(o)) * gradient;
                        sum.a += 2 * viscosity * mass / (p.density * o.density) * wallFactor(fluid.walls, p.x, at) *
                                 kernelDerivative(c.kernel, r, support) / r * du;
                        sum.rate += mass * du.dot(gradient);
                    }
        }
        return sum;
    }
};

void Forces::compare(double tolerance) {
    const Case& c = GetParam();
    FluidForces forces(fluid, *system);
    forces.findWalls(*system);
    ParticleStore& s = system->store();
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec3 a = earlier(static_cast<int>(s.id[i]), s.kindOf(i) == Kind::wall);
        s.fx[i] = a[0], s.fy[i] = a[1], s.fz[i] = a[2];
        s.densityRate[i] = earlierRate(static_cast<int>(s.id[i]));
    }
    forces.evaluate(*system, c.extrapolation);

    double error = 0, rateError = 0, size = 0, rateSize = 0;
    Vec3 onWall[2] = {Vec3::Zero(), Vec3::Zero()};
    for (std::size_t i = 0; i < s.size(); ++i) {
        const int id = static_cast<int>(s.id[i]);
        const Sum expected = bruteForce(id);
        const Vec3 a(s.fx[i], s.fy[i], s.fz[i]);
        rateError = std::max(rateError, std::abs(expected.rate - s.densityRate[i]));
        rateSize = std::max(rateSize, std::abs(expected.rate));
        if (all[id].wall) {
            EXPECT_EQ(a, Vec3(0, 0, 0));
            onWall[all[id].x[2] > 0.5 * c.size[2]] += (c.varyingMass ? all[id].mass : fluid.mass) * expected.a;
            continue;
        }
        error = std::max(error, (a - expected.a - fluid.bodyForce).norm());
        size = std::max(size, expected.a.norm());
    }
    MPI_Allreduce(MPI_IN_PLACE, &size, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &rateSize, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    EXPECT_LT(error, tolerance * size);
    EXPECT_LT(rateError, tolerance * rateSize);
    ASSERT_EQ(forces.wallForces().size(), c.walls ? 2u : 0u);
    for (std::size_t n = 0; n < forces.wallForces().size(); ++n)
        EXPECT_LT((forces.wallForces()[n] - onWall[n]).norm(), 10 * tolerance * size);
    if (c.walls) {
        EXPECT_GT(sumOverRanks(onWall[0].norm()), 0.1 * size);
    }
}

}  // namespace

TEST_P(Forces, equalThePlainDoubleLoop) { compare(1e-12); }

// Mixed precision: float rounding, 6e-8, of pressures that are large compared with their differences.
TEST_P(Forces, equalItToTheRoundingOfFloatInMixedPrecision) {
    build(Precision::mixed);
    compare(2e-6);
}

TEST_P(Forces, conserveMomentum) {
    const Case& c = GetParam();
    fluid.bodyForce.setZero();
    FluidForces forces(fluid, *system);
    forces.findWalls(*system);
    forces.evaluate(*system, 0);
    const ParticleStore& s = system->store();
    Vec3 total = Vec3::Zero();
    for (const Vec3& onWall : forces.wallForces()) total += onWall;
    double magnitude = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec3 force = (c.varyingMass ? s.mass[i] : fluid.mass) * Vec3(s.fx[i], s.fy[i], s.fz[i]);
        total += force;
        magnitude += force.norm();
    }
    MPI_Allreduce(MPI_IN_PLACE, total.data(), 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_LT(total.norm(), 1e-13 * sumOverRanks(magnitude));
}

INSTANTIATE_TEST_SUITE_P(Variants, Forces, ::testing::ValuesIn(cases),
                         [](const auto& instance) { return instance.param.name; });
