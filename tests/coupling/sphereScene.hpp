// Spherical cells in a periodic box of fluid on a disordered lattice. Nodes are particles (dual identity), or immersed
// in the fluid. Lengths in spacings, density 1.
#pragma once
#include "coupling/scene.hpp"
#include "membrane/meshes.hpp"
#include "sph/samples.hpp"

namespace corpuscle::coupling::testing {

using particles::Box;
using particles::Kind;
using particles::ParticleStore;
using particles::ParticleSystem;

inline constexpr double radius = 2.2, skin = 0.3, nodeMass = 0.4;

template <class Family>
Choice<Family> choice(const std::string& text) {
    Problems problems;
    auto chosen = readChoice<Family>(parseValue(text, "test", problems), problems);
    problems.throwIfAny();
    return chosen;
}

struct SphereScene {
    std::unique_ptr<ParticleSystem> system;
    Cells cells;
    std::vector<std::vector<Vec3>> start;  // nodes at the start, by cell
    int fluidCount = 0;

    // margin: a rank holds the cells within this distance of its brick. change: adds laws of the membranes. solute:
    // particles have room for one.
    SphereScene(const Index3& size, const std::vector<Vec3>& centres, bool immersed = false,
                double margin = Cells::everywhere, const std::function<void(membrane::MembraneSettings&)>& change = {},
                bool solute = false) {
        const Box box = sph::testing::cube(size);
        system = std::make_unique<ParticleSystem>(
            MPI_COMM_WORLD, box, ParticleStore::Optional{!immersed, false, true, !immersed, false, solute}, 2.3, skin,
            1.0);
        membrane::MembraneSettings laws;
        laws.bonds = choice<membrane::BondLaw>("{type: harmonic, k: 2 N/m}");
        laws.bending = choice<membrane::BendingLaw>("{type: dihedral, kappa: 0.3 J}");
        if (change) change(laws);
        auto mesh = membrane::testing::icosphere(2);
        for (Vec3& x : mesh.nodes) x *= radius;
        CellType type{.name = "sphere",
                      .laws = "sphere",
                      .nodes = mesh.nodes,
                      .triangles = mesh.triangles,
                      .settings = laws,
                      .radius = radius,
                      .nodeMass = std::vector<double>(mesh.nodes.size(), nodeMass)};
        for (const Vec3& centre : centres) type.places.push_back({.centre = centre});
        cells = Cells({type}, margin);
        for (std::size_t c = 0; c < centres.size(); ++c) start.push_back(cells.startingNodes(static_cast<int>(c) + 1));
        // The root makes all particles; start() sends them to their owners.
        int rank = 0;
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        ParticleStore& s = system->store();
        const auto add = [&](const Vec3& x, Kind kind, int side, int node) {
            const std::size_t i = s.size();
            s.resize(i + 1);
            s.setPosition(i, x);
            s.density[i] = 1;
            s.id[i] = static_cast<std::int64_t>(i), s.kind[i] = static_cast<std::int64_t>(kind), s.side[i] = side;
            if (!immersed) s.mass[i] = kind == Kind::membrane ? nodeMass : 1, s.node[i] = node;
        };
        if (rank == 0) {
            for (const sph::testing::Particle& p : sph::testing::lattice(size, 0.1)) {
                int side = 0;
                bool free = true;  // not too close to the membrane's nodes and facets
                for (std::size_t c = 0; c < centres.size(); ++c) {
                    const double distance = box.periodicity().shortest(p.x - centres[c]).norm();
                    if (distance < radius) side = static_cast<int>(c) + 1;
                    free &= std::abs(distance - radius) > 0.15;
                }
                if (free || immersed) add(p.x, Kind::fluid, side, -1);
            }
            int node = 0;
            for (const std::vector<Vec3>& nodes : start)
                for (std::size_t n = 0; n < nodes.size() && !immersed; ++n) add(nodes[n], Kind::membrane, 0, node++);
        }
        system->start();
        cells.placeAtStart(*system);
    }

    // Moves the system and the cells into a scene with immersed membranes, after their nodes have been moved to
    // f(position relative to the middle of the cell); the volumes after that are the ones kept.
    template <class F>
    Scene immersedScene(double rate, F&& f) && {
        for (Cell& cell : cells) {
            const Vec3 middle = middleOf(cell);
            for (Vec3& x : cell.membrane.position) x = middle + f(Vec3(x - middle));
            cell.initialVolume = cell.membrane.volume();
        }
        Scene scene;
        scene.system = std::move(system);
        scene.cells = std::move(cells);
        scene.fluidBox = scene.system->box();
        scene.fluidVolume = scene.fluidBox.volume();
        scene.spacing = 1;
        scene.flow.rate = rate;
        scene.forces = std::make_unique<sph::FluidForces>(sph::testing::model("wendlandC2"), *scene.system);
        return scene;
    }

    // x <- f(x) for the fluid, node particles to f of where they began.
    template <class F>
    void moveNodes(F&& f) {
        ParticleStore& s = system->store();
        for (std::size_t i = 0; i < s.size(); ++i)
            if (s.node[i] >= 0) {
                const auto [cell, n] = cells.cellOfNode(s.node[i]);
                const Vec3& began = start[static_cast<std::size_t>(cell) - 1][static_cast<std::size_t>(n)];
                // The image nearest to the particle's position, so that the particle moves continuously between
                // rebuilds.
                s.setPosition(i, s.position(i) + system->periodicity().shortest(f(began) - s.position(i)));
            }
    }
};

}  // namespace corpuscle::coupling::testing
