#include "simulation/sceneBuilder.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "contact/surface.hpp"
#include "core/units.hpp"
#include "coupling/immersed.hpp"
#include "geometry/periodicSurface.hpp"
#include "simulation/placement.hpp"
#include "simulation/startFiles.hpp"
#include "simulation/stressFree.hpp"

namespace corpuscle::simulation {

using coupling::Cell;
using coupling::Cells;
using coupling::CellType;
using coupling::Scene;
using particles::Kind;
using particles::ParticleStore;

std::vector<double> nodeVolumes(const std::vector<double>& vertexAreas, double spacing) {
    std::vector<double> volumes;
    volumes.reserve(vertexAreas.size());
    for (const double area : vertexAreas) volumes.push_back(area * spacing);
    return volumes;
}

namespace {

// Neighbours in the mesh must not count as contact of a membrane with itself.
void checkReach(const contact::ContactLaw& law, const CellType& type, Problems& problems) {
    double least = 1;
    for (const geometry::Place& place : type.places) least = std::min(least, place.scale);
    const double largest = least * contact::largestReach(type.nodes, type.triangles);
    if (law.range() <= largest) return;
    problems.add(
        {"constant/contact.yaml", 0, 0}, "law.reach",
        fmt::format("reach and thickness are {} together; with the mesh of cell '{}' at most {} (0.4 of its "
                    "shortest edge), or neighbours in the mesh would count as contacts of the membrane with "
                    "itself. Take a smaller reach, a larger 'edge' in system/mesh.yaml, or self: false",
                    formatQuantity(law.range(), unit::metre), type.name, formatQuantity(largest, unit::metre)));
}

std::vector<CellType> readTypes(const Case& input) {
    std::vector<CellType> types;
    Problems problems;
    for (const CellTypeSettings& settings : input.mesh.cells) {
        io::PolyData file = readStart(input, settings.name);
        const geometry::TriangleMesh mesh{std::move(file.points), std::move(file.triangles)};
        const membrane::MembraneSettings& laws = input.membraneOf(settings);
        CellType type{.name = settings.name,
                      .laws = settings.type(),
                      .nodes = mesh.nodes,
                      .triangles = mesh.triangles,
                      .stressFree = stressFreeNodes(input.directory, settings.type(), laws, mesh, problems),
                      .settings = laws,
                      .radius = settings.shape->radius(),
                      .viscosityRatio = laws.interior.viscosityRatio,
                      .places = settings.placed};
        if (!input.numerics.isImmersed())
            for (const double volume : nodeVolumes(mesh.vertexAreas(), input.spacing()))
                type.nodeMass.push_back(input.flow.density * volume);
        if (input.contact && input.contact->self) checkReach(*input.contact->law, type, problems);
        types.push_back(std::move(type));
    }
    input.throwIfAny(problems);
    return types;
}

// The number of the cell that contains a point at t = 0; 0: none.
int cellAround(const Scene& scene, const Vec3& x) {
    const Periodicity period = scene.fluidBox.periodicity();
    for (const CellType& type : scene.cells.types()) {
        const double extent = type.extent();
        for (std::size_t k = 0; k < type.places.size(); ++k) {
            const geometry::Place& place = type.places[k];
            if (period.shortest(x - place.centre).norm() > place.scale * extent) continue;
            if (geometry::InsideTest({place.of(type.nodes), type.triangles}).inside(x, period))
                return type.firstCell + static_cast<int>(k);
        }
    }
    return 0;
}

void addBodies(const Case& input, Scene& scene) {
    const io::PolyData filling = readStart(input, "bodies");
    const std::vector<std::int64_t>& number = filling.point.integer("body");
    std::vector<bodies::Body> all;
    for (const BodyPlaceSettings& place : input.mesh.bodies) {
        const io::PolyData mesh = readStart(input, place.name);
        bodies::Body body(place.name, place.type(), {mesh.points, mesh.triangles}, input.densityOf(place),
                          input.bodyOf(place).motion.model, input.support(), input.spacing());
        const geometry::PeriodicSurface surface({mesh.points, mesh.triangles}, input.support(),
                                                scene.fluidBox.periodicity());
        std::vector<Vec3> places;
        for (std::size_t k = 0; k < number.size(); ++k)
            if (number[k] == static_cast<std::int64_t>(all.size()) + 1)
                places.push_back(surface.at(filling.points[k]).image);
        body.axis = place.axis.normalized();
        body.cell = cellAround(scene, mesh.points.front());
        body.viscosity = input.fluid.viscosity;
        if (body.cell > 0) {
            Cells& cells = scene.cells;
            body.viscosity *= cells.types()[cells.typeOf(body.cell)].viscosityRatio;
            cells.setSolidVolume(body.cell, cells.solidVolume(body.cell) + body.solid.volume);
        }
        body.fill(places, input.particleVolume(), *input.numerics.kernel, input.support());
        all.push_back(std::move(body));
    }
    bodies::Bodies::Medium medium{input.flow.density, input.flow.factor * input.flow.bodyForce, input.spacing()};
    if (input.scheme().traits().solvesForBodies) medium.leastDistance = bodies::Bodies::Medium::unlimited;
    scene.bodies = std::make_unique<bodies::Bodies>(std::move(all), medium);
}

// Velocity and half the curl of the undisturbed flow, by central differences.
bodies::RigidMotion motionOfFlow(const Case& input, const Vec3& x) {
    const double step = 1e-2 * input.spacing();
    Mat3 gradient;  // (i, k): derivative of u_i along axis k
    for (int k = 0; k < 3; ++k) {
        const Vec3 along = step * Vec3::Unit(k);
        gradient.col(k) = (input.flow.undisturbed(x + along) - input.flow.undisturbed(x - along)) / (2 * step);
    }
    return {input.flow.undisturbed(x), 0.5 * Vec3(gradient(2, 1) - gradient(1, 2), gradient(0, 2) - gradient(2, 0),
                                                  gradient(1, 0) - gradient(0, 1))};
}

double harmonicMean(double a, double b) { return 2 * a * b / (a + b); }

// Calls f for this rank's share of `total` items: those with numbers in [total r/P, total (r+1)/P), r of P ranks.
template <class F>
void forShare(std::size_t total, MPI_Comm comm, F&& f) {
    int rank = 0, size = 1;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &size);
    const std::size_t r = static_cast<std::size_t>(rank), p = static_cast<std::size_t>(size);
    for (std::size_t i = total * r / p; i < total * (r + 1) / p; ++i) f(i);
}

}  // namespace

double cellMargin(const Case& c, double skin) {
    double margin = c.numerics.isImmersed() ? coupling::Immersed::margin(c.spacing(), c.support(), skin)
                                            : coupling::DualIdentity::margin(c.spacing(), skin);
    for (const CellTypeSettings& cell : c.mesh.cells)
        if (c.membraneOf(cell).pores) margin = std::max(margin, coupling::SoluteTransport::margin(c.spacing(), skin));
    return margin;
}

Scene emptyScene(const Case& input, MPI_Comm comm) {
    const bool hasCells = !input.mesh.cells.empty(), hasBodies = !input.mesh.bodies.empty();
    Scene scene;
    scene.spacing = input.spacing();
    scene.fluidBox = input.fluidBox();
    scene.flow = input.flow;
    scene.fluidVolume = input.fluidVolume();
    scene.budget = sph::Budget(input.flow.walls.count());
    scene.budget.kept = input.observers.wantBudget(input.flow.slides());
    const bool nodesAreParticles = hasCells && !input.numerics.isImmersed();
    const ParticleStore::Optional fields{.mass = nodesAreParticles || hasBodies,
                                         .viscosity = input.varyingViscosity(),
                                         .side = hasCells,
                                         .node = nodesAreParticles,
                                         .member = hasBodies,
                                         .solute = input.fluid.solute.has_value()};
    scene.system = std::make_unique<particles::ParticleSystem>(
        comm, input.particleBox(), fields, input.support(), input.scheme().traits().listsEveryStep ? 0 : input.skin(),
        input.spacing(), input.precision());
    if (input.flow.slides()) scene.system->slideImages(input.flow.gradient, input.flow.slide);
    if (hasCells) scene.cells = Cells(readTypes(input), cellMargin(input, scene.system->skin()));
    if (hasBodies) {
        addBodies(input, scene);
        if (input.scheme().traits().solvesForBodies) scene.system->pairWithinBodies();
    }
    scene.forces = std::make_unique<sph::FluidForces>(input.fluidModel(), *scene.system,
                                                      scene.bodies ? &scene.bodies->groups() : nullptr);
    if (input.flow.flowRate > 0) scene.control = std::make_unique<coupling::FlowControl>(scene.flow);
    if (input.contact && hasCells)
        scene.contacts = std::make_unique<coupling::CellContacts>(*input.contact, scene.model().walls);
    if (input.fluid.solute) scene.solute = std::make_unique<coupling::SoluteTransport>(scene.model(), *scene.system);
    if (input.numerics.shifting && !input.scheme().traits().isAdjoint)  // adjoint schemes shift within every step
        scene.shifting = std::make_unique<sph::Shifting>(*input.numerics.shifting, *input.numerics.kernel,
                                                         input.support(), input.flow.rate, input.particleMass());
    return scene;
}

namespace {

// Adds this rank's share of the initial particles to a scene; their ids are numbered kind after kind.
class StartingParticles {
  public:
    StartingParticles(const Case& input, Scene& scene)
        : input_(input), scene_(scene), s_(scene.store()), comm_(scene.system->comm()) {}

    void addFluid() {
        const sph::FluidModel& model = scene_.model();
        const io::PolyData fluid = readStart(input_, "fluid");
        const auto& side = fluid.point.integer("side");
        forShare(fluid.points.size(), comm_, [&](std::size_t k) {
            const Vec3& x = fluid.points[k];
            const double density =
                model.equationOfState->density(input_.flow.pressure(x), model.density, model.soundSpeed);
            const std::size_t i = add(Kind::fluid, k, x, input_.flow.undisturbed(x), density);
            if (s_.optional().side) s_.side[i] = side[k];
            if (s_.optional().viscosity && side[k] > 0)
                s_.viscosity[i] *= typeOf(static_cast<int>(side[k])).viscosityRatio;
            if (scene_.solute)
                s_.solute[i] =
                    scene_.solute->volume(s_, i) *
                    (side[k] > 0 ? typeOf(static_cast<int>(side[k])).settings.interior.concentration.value_or(0)
                                 : scene_.solute->solute().concentration);
        });
        firstId_ += fluid.points.size();
    }
    void addWalls() {
        const sph::FluidModel& model = scene_.model();
        if (!model.walls.exist()) return;
        const io::PolyData walls = readStart(input_, "walls");
        forShare(walls.points.size(), comm_, [&](std::size_t k) {
            const Vec3& x = walls.points[k];
            const std::size_t i = add(Kind::wall, k, x, model.walls.nearest(x).velocityAt(x), model.density);
            if (s_.optional().side) s_.side[i] = 0;
        });
        firstId_ += walls.points.size();
    }
    // The nodes of membranes, if they are particles in the coupling of the case (dual identity).
    void addNodes() {
        if (!s_.optional().node) return;
        const sph::FluidModel& model = scene_.model();
        forShare(scene_.cells.count(), comm_, [&](std::size_t c) {
            const Cell cell = scene_.cells.make(static_cast<int>(c) + 1);
            const double ratio = typeOf(cell.membrane.cell).viscosityRatio;
            for (std::size_t k = 0; k < cell.nodeMass.size(); ++k) {
                const Vec3& x = cell.membrane.position[k];
                const std::size_t node = static_cast<std::size_t>(cell.firstNode) + k;
                const std::size_t i = add(Kind::membrane, node, x, input_.flow.undisturbed(x), model.density);
                s_.mass[i] = cell.nodeMass[k];
                s_.side[i] = cell.membrane.cell;
                s_.node[i] = static_cast<std::int64_t>(node);
                if (s_.optional().viscosity) s_.viscosity[i] = model.viscosity * harmonicMean(1, ratio);
            }
        });
        firstId_ += scene_.cells.nodeCount();
    }
    void addBodies() {
        if (!scene_.bodies) return;
        for (bodies::Body& body : scene_.bodies->all()) {
            const Vec3 centre = body.state.centre;
            body.state.motion = body.behaviour->start(motionOfFlow(input_, centre));
            forShare(body.particles.size(), comm_, [&](std::size_t k) {
                const Vec3 arm = body.state.orientation * body.particles[k].place;
                const std::int64_t member = body.firstMember + static_cast<std::int64_t>(k);
                const std::size_t i = add(Kind::body, static_cast<std::size_t>(member), centre + arm,
                                          body.state.motion.at(arm), scene_.model().density);
                s_.member[i] = member;
                if (s_.optional().side) s_.side[i] = body.cell;
                if (s_.optional().viscosity) s_.viscosity[i] = body.viscosity;
            });
        }
    }

  private:
    std::size_t add(Kind kind, std::size_t number, const Vec3& x, const Vec3& u, double density) {
        const std::size_t i = s_.size();
        s_.resize(i + 1);
        s_.setPosition(i, x);
        s_.setVelocity(i, u);
        s_.density[i] = density;
        s_.id[i] = static_cast<std::int64_t>(firstId_ + number);
        s_.kind[i] = static_cast<std::int64_t>(kind);
        if (s_.optional().mass) s_.mass[i] = scene_.model().mass;
        if (s_.optional().viscosity) s_.viscosity[i] = input_.viscosityAt(x);
        if (s_.optional().node) s_.node[i] = -1;
        if (s_.optional().member) s_.member[i] = -1;
        if (s_.optional().solute) s_.solute[i] = 0;
        return i;
    }

    const CellType& typeOf(int cell) const { return scene_.cells.types()[scene_.cells.typeOf(cell)]; }

    const Case& input_;
    Scene& scene_;
    ParticleStore& s_;
    MPI_Comm comm_;
    std::size_t firstId_ = 0;
};

}  // namespace

Scene buildScene(const Case& input, MPI_Comm comm) {
    Scene scene = emptyScene(input, comm);
    StartingParticles particles(input, scene);
    particles.addFluid();
    particles.addWalls();
    particles.addNodes();
    particles.addBodies();
    scene.system->start();
    scene.cells.placeAtStart(*scene.system);
    requireClear(input, scene);
    for (Cell& cell : scene.cells) cell.membrane.openPores(0);  // those that open at once
    for (Cell& cell : scene.cells)                              // membranes move with the flow
        for (std::size_t k = 0; k < cell.membrane.velocity.size(); ++k)
            cell.membrane.velocity[k] = input.flow.undisturbed(cell.membrane.position[k]);
    return scene;
}

}  // namespace corpuscle::simulation
