// Small scenes for the tests of observers: fluid on a lattice, optionally walls across z, and red cells or spheres with
// dual identity, distributed over the ranks as in a run. dx = 1 um, mu = 1 mPa s, rho0 = 1000 kg/m^3.
#pragma once
#include "core/communicator.hpp"
#include "coupling/scene.hpp"
#include "geometry/mesher.hpp"
#include "io/temporaryFolder.hpp"
#include "observers/cells.hpp"
#include "observers/observers.hpp"
#include "support/planeWalls.hpp"

namespace corpuscle::observers::testing {

inline constexpr double um = 1e-6, dx = 1 * um, rho0 = 1000;

template <class Family>
Choice<Family> choose(const std::string& text) {
    Problems problems;
    auto choice = readChoice<Family>(parseValue(text, "test", problems), problems);
    problems.throwIfAny();
    return choice;
}

struct SampleOptions {
    Vec3 size{16 * um, 12 * um, 12 * um};
    bool walls = false;
    double shearRate = 1000;                               // 1/s; u = shearRate z with walls
    std::vector<std::pair<std::string, Vec3>> cells = {};  // name and centre
    const geometry::TriangleMesh* surface = nullptr;       // of every cell, about the origin
    std::string rupture = "none";
    double viscosityRatio = 1;                    // of the inside of cells
    double margin = coupling::Cells::everywhere;  // distance from its brick within which a rank holds cells [m]
};

inline Scene sampleScene(const SampleOptions& o) {
    const Communicator ranks;
    Scene scene;
    scene.spacing = dx;
    scene.fluidBox = {-0.5 * o.size, 0.5 * o.size, {true, true, !o.walls}};
    scene.fluidVolume = scene.fluidBox.volume();
    particles::Box box = scene.fluidBox;
    const int layers = o.walls ? 3 : 0;
    box.low[2] -= layers * dx;
    box.high[2] += layers * dx;
    scene.flow.density = rho0;
    scene.flow.shearRate = o.shearRate;
    if (o.walls) {
        const double speed = 0.5 * o.shearRate * o.size[2];
        scene.flow.walls = boundary::testing::planes(2, scene.fluidBox.low[2], scene.fluidBox.high[2],
                                                     Vec3(-speed, 0, 0), Vec3(speed, 0, 0), o.size[0] * o.size[1]);
    }
    scene.budget = sph::Budget(scene.flow.walls.count());
    const bool withCells = !o.cells.empty();
    scene.system = std::make_unique<particles::ParticleSystem>(
        MPI_COMM_WORLD, box, particles::ParticleStore::Optional{withCells, false, withCells, withCells}, 3 * dx,
        0.3 * dx, dx);

    membrane::MembraneSettings laws;
    laws.bonds = choose<membrane::BondLaw>("{type: harmonic, k: 5e-4 N/m}");
    if (o.rupture != "none") laws.rupture = choose<membrane::RuptureLaw>(o.rupture);
    std::vector<coupling::CellType> types;
    std::vector<geometry::InsideTest> insides;
    for (const auto& [name, centre] : o.cells) {
        geometry::TriangleMesh mesh = *o.surface;
        mesh.translate(centre);
        insides.emplace_back(mesh);
        types.push_back({.name = name,
                         .laws = "cell",
                         .nodes = mesh.nodes,
                         .triangles = mesh.triangles,
                         .settings = laws,
                         .radius = 4 * um,
                         .viscosityRatio = o.viscosityRatio,
                         .nodeMass = std::vector<double>(mesh.nodes.size(), rho0 * dx * dx * dx),
                         .places = {{}}});
    }
    scene.cells = coupling::Cells(types, o.margin);
    const auto sideOf = [&](const Vec3& x) {
        for (std::size_t c = 0; c < insides.size(); ++c)
            if (insides[c].inside(x, scene.system->periodicity())) return static_cast<int>(c) + 1;
        return 0;
    };

    particles::ParticleStore& s = scene.store();
    std::int64_t id = 0;
    const auto add = [&](const Vec3& x, particles::Kind kind, const Vec3& u, int side, int node) {
        const std::size_t i = s.size();
        s.resize(i + 1);
        s.setPosition(i, x), s.setVelocity(i, u);
        s.density[i] = rho0, s.kind[i] = static_cast<std::int64_t>(kind), s.id[i] = id++;
        if (withCells) s.mass[i] = rho0 * dx * dx * dx, s.side[i] = side, s.node[i] = node;
    };
    if (ranks.isRoot()) {
        Index3 counts;
        for (int k = 0; k < 3; ++k) counts[k] = static_cast<int>(std::lround(box.size()[k] / dx));
        for (int a = 0; a < counts[0]; ++a)
            for (int b = 0; b < counts[1]; ++b)
                for (int c = 0; c < counts[2]; ++c) {
                    const Vec3 x = box.low + dx * Vec3(a + 0.5, b + 0.5, c + 0.5);
                    const bool wall = c < layers || c >= counts[2] - layers;
                    const Vec3 u = wall ? scene.flow.walls.nearest(x).velocity : Vec3(o.shearRate * x[2], 0, 0);
                    add(x, wall ? particles::Kind::wall : particles::Kind::fluid, u, wall ? 0 : sideOf(x), -1);
                }
        for (const coupling::CellType& type : scene.cells.types())
            for (std::size_t n = 0; n < type.nodes.size(); ++n)
                add(type.nodes[n], particles::Kind::membrane, Vec3::Zero(), 0, type.firstNode + static_cast<int>(n));
    }
    scene.system->start();
    scene.cells.placeAtStart(*scene.system);

    sph::FluidModel model;
    model.kernel = choose<sph::Kernel>("wendlandC2").model;
    model.equationOfState = choose<sph::EquationOfState>("tait").model;
    model.density = rho0;
    model.viscosity = 1e-3;
    model.soundSpeed = 0.1;
    model.mass = rho0 * dx * dx * dx;
    model.walls = scene.flow.walls;
    scene.forces = std::make_unique<sph::FluidForces>(model, *scene.system);
    scene.forces->findWalls(*scene.system);
    return scene;
}

// Adds the coupling, which refers to the scene's cells, so the scene must not be moved afterwards.
inline void couple(Scene& scene) {
    scene.coupling = std::make_unique<coupling::DualIdentity>(scene.cells, dx,
                                                              coupling::DensityBalance(scene.fluidBox.volume(), rho0),
                                                              coupling::DualIdentity::Intervals{0, 0});
    scene.coupling->moved(*scene.system, 0, true);
}

// The network of a cell as first made, which every rank has.
inline const membrane::Network& networkOf(const Scene& scene, std::size_t cell) {
    return scene.cells.types()[cell].membrane->network();
}

// Moves the nodes of a cell to f(stress-free position of the node): the particles, and from these the membrane.
template <class F>
void deform(Scene& scene, std::size_t cell, F&& f) {
    const coupling::CellType& type = scene.cells.types()[cell];
    particles::ParticleStore& s = scene.store();
    for (std::size_t i = 0; i < s.size(); ++i) {
        const auto node = s.node[i] - type.firstNode;
        if (s.node[i] >= 0 && node >= 0 && node < static_cast<std::int64_t>(type.nodes.size()))
            s.setPosition(i, f(type.nodes[static_cast<std::size_t>(node)]));
    }
    scene.system->rebuild();
    scene.coupling->moved(*scene.system, 0, true);
}

inline std::unique_ptr<Observation> begin(const std::string& text, const Scene& scene) {
    return choose<Observer>(text)->begin(scene);
}

inline std::size_t column(const Table& table, const std::string& header) {
    for (std::size_t k = 0; k < table.columns.size(); ++k)
        if (table.columns[k].header() == header) return k;
    throw std::runtime_error("no column " + header);
}

// The value under a header in the first row of a table.
inline double value(const Observation& observation, const std::vector<Row>& rows, const std::string& header,
                    std::size_t table = 0) {
    for (const Row& row : rows)
        if (row.table == table) return row.values.at(column(observation.tables()[table], header));
    throw std::runtime_error("no row of this table");
}

}  // namespace corpuscle::observers::testing
