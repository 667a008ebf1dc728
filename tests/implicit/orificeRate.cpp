// Flow rate through a round hole of radius a in a spherical membrane. The membrane may move along its normals, all
// nodes with one velocity, and as a whole; a pressure p on it drives the fluid out. In Stokes flow Q = f a^3 p/(3 mu):
// f = 1 for a hole in a plane (Sampson, Phil. Trans. R. Soc. A 182 (1891) 449), 0.943 for this sphere, whose radius is
// 2.5 a (own computation: axisymmetric boundary elements, 24 and 48 of them, extrapolated; 0.996 with a radius of
// 10 a). Lengths in spacings, viscosity 1.
#include <gtest/gtest.h>

#include "coupling/immersed.hpp"
#include "implicit/coarseGrid.hpp"
#include "implicit/conjugateGradients.hpp"
#include "implicit/fluidTerm.hpp"
#include "tornSphere.hpp"

using namespace corpuscle;
using namespace corpuscle::implicit;
using namespace corpuscle::implicit::testing;
using Field = ConjugateGradients<double>::Field;
using Vectors = coupling::Immersed::Vectors;

namespace {

constexpr double expected = 0.943;

// A membrane with a hole of radius a in fluid at rest.
struct Orifice {
    static constexpr double bulk = 500, jitter = 0.1, inertia = 1e-6, stiffness = 2000;
    double a, radius;
    int length;
    sph::FluidModel model = fluid(1);
    coupling::testing::FluidScene f;
    FluidTerm<double> term{f.scene, {}};
    coupling::Cells cells;
    std::unique_ptr<coupling::Immersed> immersed;
    CoarseGrid grid{f.scene.system->box(), CoarseGrid::spacingInParticles};
    particles::RealArray rows;  // diagonal and position of every entry
    Vectors areas;              // around nodes, of the whole triangles
    std::vector<Vectors> free;  // velocities that the membrane may have, orthonormal: of the whole, and along normals
    double fluxOfNormals = 0;   // through the membrane, per velocity along its normals
    double radial = 0;          // velocity along normals per velocity free[3]

    Orifice(double a_, int level, int length_)
        : a(a_),
          radius(a_ / holeOverSphere),
          length(length_),
          f(coupling::testing::still({length_, length_, length_}, jitter), {length_, length_, length_}, model, 1, 0,
            MPI_COMM_WORLD, particles::Precision::full) {
        particles::ParticleStore& s = f.scene.store();
        std::fill(s.density.begin(), s.density.end(), 1.0);
        term.prepare({bulk});
        TornSphere torn(level);
        const Vectors unit = torn.mesh.nodes;
        for (Vec3& x : torn.mesh.nodes) x = radius * x + middleOf(length);
        membrane::MembraneSettings laws;
        laws.bonds = coupling::testing::choice<membrane::BondLaw>("{type: harmonic, k: 1 N/m}");
        cells.add({.membrane = membrane::Membrane("sphere", 1, torn.mesh.nodes, torn.mesh.triangles, laws, radius),
                   .radius = radius});
        cells[0].membrane.restore(torn.alive);
        const membrane::Network& network = cells[0].membrane.network();
        std::vector<Index3> whole;
        for (const int t : network.wholeTriangles()) whole.push_back(network.triangles()[t]);
        areas = membrane::volumeGradient(torn.mesh.nodes, whole);
        const std::vector<int> sheet = network.sheetOfNodes();
        free.assign(4, Vectors(areas.size(), Vec3::Zero()));
        for (std::size_t m = 0; m < areas.size(); ++m) {
            if (sheet[m] < 0) continue;
            for (int k = 0; k < 3; ++k) free[static_cast<std::size_t>(k)][m] = Vec3::Unit(k);
            free[3][m] = unit[m], fluxOfNormals += areas[m].dot(unit[m]);
        }
        for (std::size_t k = 0; k < free.size(); ++k) {
            for (std::size_t j = 0; j < k; ++j) add(free[k], -dot(free[j], free[k]), free[j]);
            const double norm = std::sqrt(dot(free[k], free[k]));
            for (Vec3& v : free[k]) v /= norm;
            radial = 1 / norm;
        }
        immersed = std::make_unique<coupling::Immersed>(cells, model, *f.scene.system);
        immersed->place(*f.scene.system, term.operators().volumes());
        grid.setCoefficients(inertia, 1, bulk);
        rows.resize(4 * shared().entries());
        for (std::size_t i = 0; i < s.size(); ++i) {
            rows[4 * i] = term.diagonal(i);
            Vec3::Map(&rows[4 * i + 1]) = s.position(i);
        }
        shared().distribute(rows.data(), 4);
        grid.begin(s.size(), shared().entries() - s.size());
        for (std::size_t i = 0; i < shared().entries(); ++i) grid.place(i, Vec3::Map(&rows[4 * i + 1]));
    }
    particles::SharedParticles& shared() { return term.operators().shared(); }

    static void add(Vectors& v, double factor, const Vectors& w) {
        for (std::size_t m = 0; m < v.size(); ++m) v[m] += factor * w[m];
    }
    // Force that opposes what the membrane may not do.
    Vectors resistance(Vectors v) const {
        for (const Vectors& one : free) add(v, -dot(one, v), one);
        const std::vector<int> sheet = cells[0].membrane.network().sheetOfNodes();
        for (std::size_t m = 0; m < v.size(); ++m) v[m] *= sheet[m] < 0 ? 0 : -stiffness;
        return v;
    }

    struct Result {
        double rate, pressure;  // flux through the membrane, less that by its motion as a whole; power over this flux
        int iterations;
    };
    // Under a load without net force that drives the membrane inwards along its normals.
    Result flow() {
        const std::size_t n = shared().entries();
        particles::RealArray force(4 * n, 0.0), forces;
        Vectors load = free[3];
        for (Vec3& one : load) one = -one;
        immersed->spread(load, force);
        shared().distribute(force.data(), 4);
        Field r(force.begin(), force.end()), v;
        const Convergence c = ConjugateGradients<double>().solve(
            MPI_COMM_WORLD, r, v, 0, 1e-4,
            [&](const Field& z, Field& w) {
                forces.assign(4 * n, 0.0);
                immersed->spread(resistance(immersed->interpolate(z.data())), forces);
                term.addProduct(z, forces);
                for (std::size_t k = 0; k < w.size(); ++k) w[k] = k % 4 == 3 ? 0 : inertia * z[k] - forces[k];
            },
            [&](const Field& of, Field& z) {
                for (std::size_t i = 0; i < n; ++i) {
                    for (std::size_t k = 0; k < 3; ++k) z[4 * i + k] = of[4 * i + k] / rows[4 * i];
                    z[4 * i + 3] = 0;
                }
                grid.add(MPI_COMM_WORLD, of.data(), z.data());
            },
            Copies{4 * f.scene.store().size(), 4 * n});
        EXPECT_TRUE(c.reached);
        const Vectors nodes = immersed->interpolate(v.data());
        double power = 0;
        for (std::size_t k = 0; k < 4 * f.scene.store().size(); ++k) power += force[k] * v[k];
        power = sph::testing::sumOverRanks(power);
        EXPECT_NEAR(power / dot(load, nodes), 1, 1e-9);
        const double rate = radial * dot(load, nodes) * fluxOfNormals;
        return {rate, power / rate, c.iterations};
    }
};

}  // namespace

TEST(Orifice, flowRateIsNearThatOfAHole) {
    struct {
        double a;
        int level, length;
        double low, high;
    } const cases[] = {{3, 3, 24, 0.57, 0.95}, {6, 4, 48, 0.76, 0.95}};
    for (const auto& c : cases) {
        Orifice orifice(c.a, c.level, c.length);
        EXPECT_EQ(orifice.immersed->fallbacks(), 0);
        const Orifice::Result flow = orifice.flow();
        const double ratio = flow.rate / (expected * std::pow(c.a, 3) * flow.pressure / 3);
        std::printf("a = %g: Q over the expected one %.4f, %d iterations\n", c.a, ratio, flow.iterations);
        EXPECT_GT(ratio, c.low);
        EXPECT_LT(ratio, c.high);
    }
}
