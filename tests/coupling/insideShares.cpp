#include "coupling/insideShares.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/fluidScene.hpp"
#include "coupling/sphereScene.hpp"

using namespace corpuscle;
using namespace corpuscle::coupling;
using namespace corpuscle::coupling::testing;

namespace {

constexpr int length = 16;

// A cell in the shape of an oblate spheroid in fluid on a lattice, every particle of volume 1.
struct Inclusion : FluidScene {
    Inclusion(double radius, double ratio, const Vec3& centre, double viscosityRatio)
        : FluidScene(
              still({length, length, length}), {length, length, length},
              [] {
                  sph::FluidModel model = sph::testing::model("wendlandC2", "linear");
                  model.viscosity = 1;
                  return model;
              }(),
              1, 0, MPI_COMM_WORLD, particles::Precision::full, fields()) {
        membrane::MembraneSettings laws;
        laws.bonds = choice<membrane::BondLaw>("{type: harmonic, k: 1 N/m}");
        auto mesh = membrane::testing::icosphere(4);
        for (Vec3& x : mesh.nodes) x = radius * Vec3(x[0], x[1], ratio * x[2]);
        CellType type{.name = "spheroid",
                      .laws = "spheroid",
                      .nodes = mesh.nodes,
                      .triangles = mesh.triangles,
                      .settings = laws,
                      .radius = radius,
                      .viscosityRatio = viscosityRatio};
        type.places.push_back({.centre = centre});
        scene.cells = Cells({type});
        scene.cells.placeAtStart(*scene.system);
        particles::ParticleStore& s = scene.store();
        for (std::size_t i = 0; i < s.size(); ++i) {
            const Vec3 d = scene.system->periodicity().shortest(s.position(i) - centre);
            if (Vec3(d[0], d[1], d[2] / ratio).norm() < radius) s.side[i] = 1, s.viscosity[i] = viscosityRatio;
        }
    }
    static particles::ParticleStore::Optional fields() {
        particles::ParticleStore::Optional fields;
        fields.viscosity = fields.side = true;
        return fields;
    }
    double volume() {
        NoFlux noFlux(scene.cells, scene.spacing);
        std::vector<int> every(scene.store().size());
        for (std::size_t i = 0; i < every.size(); ++i) every[i] = static_cast<int>(i);
        noFlux.findAmong(*scene.system, 0, [&](std::size_t) { return every; });
        Immersed immersed(scene.cells, scene.model(), *scene.system);
        immersed.place(*scene.system, std::vector<double>(every.size(), 1.0));
        const std::vector<sph::Inside> inside = insideShares(scene, &noFlux, &immersed);
        return sum([&](std::size_t i) { return inside[i].share; });
    }
};

}  // namespace

// Without the curvature term of the shares the sums would be too large by 1/(4 a^2), 1.9 % for the sphere and 2.1 % for
// the spheroid.
TEST(InsideShares, addUpToWhatTheMembraneEncloses) {
    for (const auto& [radius, ratio] : {std::pair{3.6, 1.0}, std::pair{6.0, 0.3}})
        for (const double viscosityRatio : {0.2, 5.0}) {
            double sum = 0, enclosed = 0;
            for (const double place : {0.02, 0.13, 0.27, 0.36, 0.49}) {
                Inclusion s(radius, ratio, Vec3(8 + place, 1 + 2 * place, 15.9 + 3 * place), viscosityRatio);
                const membrane::Membrane& m = s.scene.cells[0].membrane;
                enclosed = membrane::enclosedVolume(m.position, m.network().triangles());
                sum += s.volume() / 5;
            }
            std::printf("a %.1f, r %.1f: shares add up to %.3f, enclosed %.3f\n", radius, ratio, sum, enclosed);
            EXPECT_NEAR(sum, enclosed, 4e-3 * enclosed);
        }
}
