#include "simulation/sceneBuilder.hpp"

#include "simulation/startFiles.hpp"
#include "simulation/stressFree.hpp"

namespace corpuscle::simulation {

using coupling::Cell;
using coupling::Scene;
using particles::Kind;
using particles::ParticleStore;

std::vector<double> nodeVolumes(const std::vector<double>& vertexAreas, double spacing) {
    std::vector<double> volumes;
    for (const double area : vertexAreas) volumes.push_back(area * spacing);
    return volumes;
}

namespace {

std::vector<Cell> readCells(const Case& input) {
    std::vector<Cell> cells;
    int firstNode = 0;
    Problems problems;
    for (const CellSettings& settings : input.mesh.cells) {
        io::PolyData file = readStart(input, settings.name);
        const geometry::TriangleMesh mesh{std::move(file.points), std::move(file.triangles)};
        const membrane::MembraneSettings& laws = input.membraneOf(settings);
        const double a = settings.shape->radius();
        Cell cell{.membrane = membrane::Membrane(
                      settings.name, static_cast<int>(cells.size()) + 1, mesh.nodes, mesh.triangles, laws, a,
                      stressFreeNodes(input.directory, settings.type(), laws, mesh, problems)),
                  .type = settings.type(),
                  .radius = a,
                  .viscosityRatio = laws.interior.viscosityRatio,
                  .firstNode = firstNode};
        cell.initialArea = cell.membrane.area();
        cell.initialVolume = cell.membrane.volume();
        for (const double volume : nodeVolumes(cell.membrane.vertexAreas(), input.spacing()))
            cell.nodeMass.push_back(input.flow.density * volume);
        firstNode += cell.nodeCount();
        cells.push_back(std::move(cell));
    }
    input.throwIfAny(problems);
    return cells;
}

double harmonicMean(double a, double b) { return 2 * a * b / (a + b); }

// Adds this rank's share of `total` things: those with numbers in [total r/P, total (r+1)/P).
template <class F>
void forShare(std::size_t total, MPI_Comm comm, F&& f) {
    int rank = 0, size = 1;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &size);
    const std::size_t r = static_cast<std::size_t>(rank), p = static_cast<std::size_t>(size);
    for (std::size_t i = total * r / p; i < total * (r + 1) / p; ++i) f(i);
}

}  // namespace

Scene emptyScene(const Case& input, MPI_Comm comm) {
    const bool hasCells = !input.mesh.cells.empty();
    Scene scene;
    scene.spacing = input.spacing();
    scene.fluidBox = input.fluidBox();
    scene.flow = input.flow;
    const ParticleStore::Optional fields{
        .mass = hasCells, .viscosity = input.varyingViscosity(), .side = hasCells, .node = hasCells};
    scene.system = std::make_unique<particles::ParticleSystem>(comm, input.particleBox(), fields, input.support(),
                                                               input.skin(), input.spacing(), input.precision());
    scene.forces = std::make_unique<sph::FluidForces>(input.fluidModel(), *scene.system);
    if (input.numerics.shifting)
        scene.shifting = std::make_unique<sph::Shifting>(*input.numerics.shifting, *input.numerics.kernel,
                                                         input.support(), input.flow.rate, input.particleMass());
    if (hasCells) scene.cells = readCells(input);
    return scene;
}

Scene buildScene(const Case& input, MPI_Comm comm) {
    Scene scene = emptyScene(input, comm);
    ParticleStore& s = scene.store();
    const sph::FluidModel& model = scene.model();
    std::int64_t firstId = 0;
    const auto add = [&](Kind kind, std::int64_t id, const Vec3& x, const Vec3& u, double density) {
        const std::size_t i = s.size();
        s.resize(i + 1);
        s.setPosition(i, x);
        s.setVelocity(i, u);
        s.density[i] = density;
        s.id[i] = id;
        s.kind[i] = static_cast<std::int64_t>(kind);
        if (s.optional().mass) s.mass[i] = model.mass;
        if (s.optional().viscosity) s.viscosity[i] = model.viscosity;
        if (s.optional().node) s.node[i] = -1;
        return i;
    };

    const io::PolyData fluid = readStart(input, "fluid");
    const auto& side = fluid.point.integer("side");
    forShare(fluid.points.size(), comm, [&](std::size_t k) {
        const Vec3& x = fluid.points[k];
        const double density = model.equationOfState->density(input.flow.pressure(x), model.density, model.soundSpeed);
        const std::size_t i = add(Kind::fluid, static_cast<std::int64_t>(k), x, input.flow.velocity(x), density);
        if (s.optional().side) s.side[i] = side[k];
        if (s.optional().viscosity && side[k] > 0)
            s.viscosity[i] *= scene.cells[static_cast<std::size_t>(side[k] - 1)].viscosityRatio;
    });
    firstId += static_cast<std::int64_t>(fluid.points.size());

    if (model.walls.exist()) {
        const io::PolyData walls = readStart(input, "walls");
        forShare(walls.points.size(), comm, [&](std::size_t k) {
            const Vec3& x = walls.points[k];
            const std::size_t i = add(Kind::wall, firstId + static_cast<std::int64_t>(k), x,
                                      model.walls.velocity[model.walls.isUpper(x)], model.density);
            if (s.optional().side) s.side[i] = 0;
        });
        firstId += static_cast<std::int64_t>(walls.points.size());
    }

    for (Cell& cell : scene.cells) {
        for (std::size_t k = 0; k < cell.nodeMass.size(); ++k)
            cell.membrane.velocity[k] = input.flow.velocity(cell.membrane.position[k]);
        forShare(cell.nodeMass.size(), comm, [&](std::size_t k) {
            const std::size_t i = add(Kind::membrane, firstId + cell.firstNode + static_cast<std::int64_t>(k),
                                      cell.membrane.position[k], cell.membrane.velocity[k], model.density);
            s.mass[i] = cell.nodeMass[k];
            s.side[i] = cell.membrane.cell;
            s.node[i] = cell.firstNode + static_cast<std::int64_t>(k);
            if (s.optional().viscosity) s.viscosity[i] = model.viscosity * harmonicMean(1, cell.viscosityRatio);
        });
    }
    scene.system->start();
    return scene;
}

}  // namespace corpuscle::simulation
