// Velocity of the nodes of a loaded membrane in fluid: a sphere in fluid at rest, loaded by one spherical harmonic of
// degree l, against Stokes flow, where the points of the sphere move under a traction f with
//
//     u = a/mu f/(2l + 1)                                        for f = r x grad Y                (a twist)
//     u = a/mu l/((2l + 1)(2l + 3)) f                            for f = grad_s Y - (l + 1) Y n
//     u = a/mu (l + 1)/((2l + 1)(2l - 1)) f                      for f = grad_s Y + l Y n
// (equal viscosities; single-layer operator on vector spherical harmonics, for example Veerapaneni et al., J. Comput.
// Phys. 230 (2011) 5610). Combinations of the last two give, for a load along grad_s Y or along n, the velocity along
// each. The moments v', r, r' of the weights (coupling/nodeFluidMap.hpp) are chosen by these responses. Lengths in
// spacings, viscosity 1.
#include <gtest/gtest.h>

#include <numbers>

#include "coupling/fluidScene.hpp"
#include "coupling/immersed.hpp"
#include "coupling/sphereScene.hpp"
#include "implicit/coarseGrid.hpp"
#include "implicit/conjugateGradients.hpp"
#include "implicit/fluidTerm.hpp"
#include "membrane/surface.hpp"

using namespace corpuscle;
using namespace corpuscle::implicit;
using Field = ConjugateGradients<double>::Field;
using Vectors = coupling::Immersed::Vectors;

namespace {

constexpr double a = 6, jitter = 0.1, bulk = 500, tolerance = 1e-4;  // bulk: time x K/mu, practically incompressible
constexpr int length = 36;

struct Legendre {
    double value, slope;
};
Legendre legendre(int l, double x) {
    double before = 1, value = x, slopeBefore = 0, slope = 1;
    for (int k = 2; k <= l; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k, rise = slopeBefore + (2 * k - 1) * value;
        before = std::exchange(value, next), slopeBefore = std::exchange(slope, rise);
    }
    return {value, slope};
}

// Tractions of zonal harmonics on the nodes.
struct Loads {
    Vectors twist, along, across;
    Loads(const Vectors& unit, int l) {
        for (const Vec3& n : unit) {
            const auto [value, slope] = legendre(l, n[2]);
            along.push_back(slope * (Vec3::UnitZ() - n[2] * n));
            twist.push_back(n.cross(along.back()));
            across.push_back(value * n);
        }
    }
};

struct LoadedSphere {
    sph::FluidModel model = fluid();
    coupling::testing::FluidScene f{coupling::testing::still({length, length, length}, jitter),
                                    {length, length, length},
                                    model,
                                    1,
                                    0,
                                    MPI_COMM_WORLD,
                                    particles::Precision::full};
    FluidTerm<double> term{f.scene, {}};
    coupling::Cells cells;
    Vectors unit, areas;
    double area = 0;  // of the mesh, over that of the sphere
    std::unique_ptr<coupling::Immersed> immersed;
    CoarseGrid grid{f.scene.system->box(), CoarseGrid::spacingInParticles};
    particles::RealArray rows;  // diagonal and position of every entry

    static sph::FluidModel fluid() {
        sph::FluidModel m = sph::testing::model("wendlandC2", "linear");
        m.viscosity = 1, m.soundSpeed = 1;
        return m;
    }

    LoadedSphere() {
        particles::ParticleStore& s = f.scene.store();
        std::fill(s.density.begin(), s.density.end(), 1.0);
        term.prepare({bulk});
        membrane::MembraneSettings laws;
        laws.bonds = coupling::testing::choice<membrane::BondLaw>("{type: harmonic, k: 1 N/m}");
        auto mesh = membrane::testing::icosphere(3);
        unit = mesh.nodes;
        const Vec3 centre = Vec3::Constant(0.5 * length) + Vec3(0.13, -0.21, 0.07);
        for (Vec3& x : mesh.nodes) x = a * x + centre;
        cells.add({.membrane = membrane::Membrane("sphere", 1, mesh.nodes, mesh.triangles, laws, a), .radius = a});
        immersed = std::make_unique<coupling::Immersed>(cells, model, *f.scene.system);
        immersed->place(*f.scene.system, term.operators().volumes());
        areas = membrane::volumeGradient(mesh.nodes, mesh.triangles);
        for (const Vec3& g : areas) area += g.norm() / (4 * std::numbers::pi * a * a);
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

    // Velocity of the nodes over a/mu, under a traction.
    Vectors response(Vectors load) {
        for (std::size_t m = 0; m < load.size(); ++m) load[m] *= areas[m].norm();
        const std::size_t n = shared().entries();
        particles::RealArray force(4 * n, 0.0), forces;
        immersed->spread(load, force);
        shared().distribute(force.data(), 4);
        Field r(force.begin(), force.end()), v;
        const Convergence c = ConjugateGradients<double>().solve(
            MPI_COMM_WORLD, r, v, 0, tolerance,
            [&](const Field& z, Field& w) {
                forces.assign(4 * n, 0.0);
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
        Vectors found = immersed->interpolate(v.data());
        for (Vec3& u : found) u /= a * area;
        return found;
    }
    // Projection of v on the field: the factor of the field in v.
    double part(const Vectors& v, const Vectors& field) const {
        double both = 0, square = 0;
        for (std::size_t m = 0; m < v.size(); ++m) {
            both += areas[m].norm() * v[m].dot(field[m]);
            square += areas[m].norm() * field[m].squaredNorm();
        }
        return both / square;
    }

    static constexpr double inertia = 1e-6;  // makes the mean velocity of the box zero
};

}  // namespace

TEST(LoadedSphere, nodesMoveAsInStokesFlow) {
    LoadedSphere sphere;
    EXPECT_EQ(sphere.immersed->fallbacks(), 0);
    for (const int l : {3, 4}) {
        const Loads loads(sphere.unit, l);
        const double v = l / ((2. * l + 1) * (2 * l + 3)), w = (l + 1) / ((2. * l + 1) * (2 * l - 1)), n = 2 * l + 1;
        const Vectors along = sphere.response(loads.along), across = sphere.response(loads.across);
        const struct {
            const char* what;
            double found, exact, allowed;
        } responses[] = {
            {"twist", sphere.part(sphere.response(loads.twist), loads.twist), 1 / n, 0.05},
            {"along, of a load along", sphere.part(along, loads.along), ((l + 1) * w + l * v) / n, 0.18},
            {"across, of a load along", sphere.part(along, loads.across), l * (l + 1) * (w - v) / n, 0.05},
            {"along, of a load across", sphere.part(across, loads.along), (w - v) / n, 0.05},
            {"across, of a load across", sphere.part(across, loads.across), (l * w + (l + 1) * v) / n, 0.03},
        };
        for (const auto& r : responses) {
            std::printf("degree %d, %s: %.5f (%.5f), %+.1f %%\n", l, r.what, r.found, r.exact,
                        100 * (r.found / r.exact - 1));
            EXPECT_NEAR(r.found / r.exact, 1, r.allowed) << r.what << ", degree " << l;
        }
    }
}
