// A scene of fluid alone for time steps with adjoint operators. Lengths in spacings, density 1, kernel support 2.4.
#pragma once
#include "coupling/scene.hpp"
#include "sph/samples.hpp"

namespace corpuscle::coupling::testing {

inline constexpr double fluidSupport = 2.4;

inline std::vector<sph::testing::Particle> still(const Index3& size, double disorder = 0) {
    std::vector<sph::testing::Particle> all = sph::testing::lattice(size, disorder);
    for (sph::testing::Particle& p : all) p.u *= disorder, p.density = p.mass = p.viscosity = 1;
    return all;
}

// A lattice of particles with a spherical hole around the origin, which is at a corner of the periodic box.
inline std::vector<sph::testing::Particle> withHole(const Index3& size, double radius) {
    std::vector<sph::testing::Particle> all = still(size);
    std::erase_if(all, [&](const sph::testing::Particle& p) {
        Vec3 x = p.x;
        for (int k = 0; k < 3; ++k) x[k] -= size[k] * std::round(x[k] / size[k]);
        return x.norm() < radius;
    });
    return all;
}

// Fluid on a disordered lattice, moving with the flow, between walls whose particles are on the undisturbed lattice and
// move with the walls.
template <class Flow>
std::vector<sph::testing::Particle> sheared(const Index3& size, double jitter, const boundary::Walls& walls,
                                            Flow&& flow) {
    std::vector<sph::testing::Particle> all = sph::testing::lattice(size, jitter),
                                        places = sph::testing::lattice(size, 0);
    for (std::size_t i = 0; i < all.size(); ++i) {
        sph::testing::Particle& p = all[i];
        p.wall = walls.distance(places[i].x) < 0;
        if (p.wall) p.x = places[i].x;
        p.u = p.wall ? walls.nearest(p.x).velocity : flow(p.x);
        p.density = p.mass = p.viscosity = 1;
    }
    return all;
}

struct FluidScene {
    Scene scene;

    FluidScene(const std::vector<sph::testing::Particle>& all, const Index3& size, const sph::FluidModel& model,
               double rate, double skin, MPI_Comm comm, particles::Precision precision,
               particles::ParticleStore::Optional fields = {}) {
        scene.system = std::make_unique<particles::ParticleSystem>(comm, sph::testing::cube(size, model.walls.exist()),
                                                                   fields, fluidSupport, skin, 1.0, precision);
        sph::testing::deal(all, *scene.system);
        scene.fluidBox = scene.system->box();
        scene.fluidVolume = scene.fluidBox.volume();
        scene.budget = sph::Budget(model.walls.count());
        scene.spacing = 1;
        scene.flow.rate = rate;
        scene.flow.length = static_cast<double>(size[2]);
        scene.forces = std::make_unique<sph::FluidForces>(model, *scene.system);
    }
    // sum of f(index in the store) over the particles of all ranks
    template <class F>
    double sum(F&& f) const {
        double total = 0;
        for (std::size_t i = 0; i < scene.store().size(); ++i) total += f(i);
        return sph::testing::sumOverRanks(total);
    }
};

}  // namespace corpuscle::coupling::testing
