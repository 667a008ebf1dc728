// checkMesh: checks that the contents of 0/ are valid and match the case.
//
// Cells and rigid bodies have to be closed surfaces of the right shape and edge length, inside the box and clear of
// each other. Particles have to be as many as the lattice gives, on the right side of membranes (by an inside test
// other than particleFill's), as many in each cell as its volume requires, and not on top of each other. Nothing is
// written. The output ends with "Mesh OK." or with the failed checks, exit code 2.
//
// Sample runs:
//     checkMesh -case tutorials/rbcShear/Ca0.02
//     checkMesh -case tutorials/rbcShear/Ca0.02 -json
#include <iostream>
#include <nlohmann/json.hpp>

#include "../cellMeshes.hpp"
#include "geometry/latticeFill.hpp"
#include "geometry/sidesByRays.hpp"
#include "neighbours.hpp"
#include "simulation/placement.hpp"
#include "simulation/sceneBuilder.hpp"
#include "simulation/size.hpp"

using namespace corpuscle;
using geometry::TriangleMesh;
using nlohmann::ordered_json;
using simulation::Case;

namespace {

constexpr double leastAngle = 20;       // degrees
constexpr double edgeTolerance = 0.05;  // relative, for the mean edge
// Distance of nodes from the shape, relative to its radius; relative error of a volume that is to be enclosed exactly.
constexpr double surfaceTolerance = 1e-6;
// Distance of nodes from the shape if they are moved to enclose its volume, in edges.
constexpr double moveTolerance = 0.25;
constexpr double leastDistance = 0.25;      // between two particles, in spacings
constexpr double leastNodeDistance = 0.1;   // between a fluid particle and a node, in spacings
constexpr double leastCellDistance = 0.25;  // between nodes of two cells, in spacings
// A flat face may lie between two layers of the lattice: largest error of a particle count, in layers of the area of
// the surface.
constexpr double facesOffLattice = 0.25;

using Faults = std::vector<std::string>;

// isSound: set to false if the mesh is not a closed surface.
geometry::MeshQuality checkSurface(const simulation::SurfaceSettings& surface, const TriangleMesh& mesh, bool& isSound,
                                   const std::function<void(const std::string&)>& fault) {
    geometry::MeshQuality quality =
        geometry::meshQuality(utilities::inShapeFrame(mesh, surface), surface.shape.model.get());
    for (const std::string& text : geometry::checkClosedManifold(mesh)) {
        isSound = false;
        fault(text);
    }
    if (quality.euler != 2)
        fault(fmt::format("Euler characteristic {} instead of 2: not one surface without handles", quality.euler));
    if (quality.angleMin < leastAngle)
        fault(fmt::format("smallest angle {:.1f} degrees, below {}", quality.angleMin, leastAngle));
    if (std::abs(quality.edgeMean / surface.edge - 1) > edgeTolerance)
        fault(fmt::format("mean edge {}, but system/mesh.yaml asks for {}: run membraneMesh again",
                          formatQuantity(quality.edgeMean, unit::metre), formatQuantity(surface.edge, unit::metre)));
    const double tolerance =
        surface.enclosesExactly() ? moveTolerance * surface.edge / surface.shape->radius() : surfaceTolerance;
    if (!(quality.residual <= tolerance))
        fault(fmt::format("nodes lie up to {:.2g} radii off the shape of system/mesh.yaml: run membraneMesh again",
                          quality.residual));
    if (surface.enclosesExactly() && !(std::abs(quality.volumeError) <= surfaceTolerance))
        fault(
            fmt::format("the mesh encloses {:+.2g} % more than the shape, but system/mesh.yaml says `enclose: exact`: "
                        "run membraneMesh again",
                        100 * quality.volumeError));
    return quality;
}

// Whether the mesh resolves the length over which the sheet weakens before it tears, if its rupture law has one.
void checkTearLength(Application& app, const membrane::MembraneSettings& laws, double edge, ordered_json& json,
                     const std::function<void(const std::string&)>& fault) {
    const std::optional<double> length = laws.rupture ? laws.rupture->resolvedLength() : std::nullopt;
    if (!length) return;
    const double edges = *length / edge, least = 1 / membrane::RuptureLaw::edgeOfResolvedLength;
    app.log().info("  the length of its tears, {}, is {:.2f} mean edges ({} or more resolve it)",
                   formatQuantity(*length, unit::metre), edges, least);
    json["tearLengthInEdges"] = edges;
    if (edges < (1 - edgeTolerance) * least)
        fault(
            fmt::format("the length of its tears in constant/membranes.yaml, {}, is {:.2f} mean edges, and {} or more "
                        "are needed to resolve it: take a finer mesh or a greater length",
                        formatQuantity(*length, unit::metre), edges, least));
}

// Returns whether all meshes are closed surfaces; likewise checkBodies.
bool checkCells(Application& app, const Case& input, const std::vector<TriangleMesh>& meshes, ordered_json& json,
                Faults& faults) {
    bool areSound = true;
    for (std::size_t c = 0; c < meshes.size(); ++c) {
        const simulation::CellSettings& cell = input.mesh.cells[c];
        const auto fault = [&](const std::string& text) { faults.push_back("cell '" + cell.name + "': " + text); };
        const geometry::MeshQuality quality = checkSurface(cell, meshes[c], areSound, fault);
        app.log().info("cell {}\n{}", cell.name, utilities::indented(quality.text()));
        checkTearLength(app, input.membraneOf(cell), quality.edgeMean, json["cells"][cell.name], fault);
        json["cells"][cell.name]["quality"] = utilities::toJson(quality);
        try {
            const membrane::NetworkModuli moduli = utilities::moduliOf(meshes[c], input.membraneOf(cell));
            app.log().info("{}", utilities::indented(membrane::describe(moduli)));
            json["cells"][cell.name]["moduli"] = utilities::toJson(moduli);
        } catch (const Failure& failure) {  // the mesh allows no network
            fault(failure.what());
        }
    }
    return areSound;
}

bool checkBodies(Application& app, const Case& input, const std::vector<TriangleMesh>& meshes, ordered_json& json,
                 Faults& faults) {
    bool areSound = true;
    for (std::size_t b = 0; b < meshes.size(); ++b) {
        const simulation::BodyPlaceSettings& body = input.mesh.bodies[b];
        const geometry::MeshQuality quality = checkSurface(body, meshes[b], areSound, [&](const std::string& text) {
            faults.push_back("body '" + body.name + "': " + text);
        });
        const bodies::Solid solid(meshes[b], input.densityOf(body));
        app.log().info("body {}\n{}\n{}", body.name, utilities::indented(quality.text()),
                       utilities::indented(utilities::describe(solid)));
        json["bodies"][body.name] = {{"quality", utilities::toJson(quality)}, {"solid", utilities::toJson(solid)}};
    }
    return areSound;
}

// Checks that the lattice points are as many as the fluid particles, the particles of bodies, and the fluid particles
// displaced by nodes together.
void checkLattice(Application& app, const Case& input, const std::vector<TriangleMesh>& meshes, std::size_t fluid,
                  std::size_t walls, std::size_t bodies, ordered_json& json, Faults& faults) {
    long count[3];
    double nodeVolume = 0;
    std::size_t nodes = 0;
    for (const TriangleMesh& mesh : meshes) {
        nodes += mesh.nodes.size();
        if (!input.numerics.isImmersed())
            for (const double volume : simulation::nodeVolumes(mesh.vertexAreas(), input.spacing()))
                nodeVolume += volume;
    }
    for (int k = 0; k < 3; ++k) count[k] = std::lround(input.mesh.domain.size[k] / input.spacing());
    const simulation::ParticleEstimate whole = simulation::estimateLattice(input);
    const long lattice = std::lround(whole.fluid), wantedWalls = std::lround(whole.walls);
    // Plane walls leave whole layers. Along other walls the lattice may lose or gain part of a layer.
    long slack = 0;
    if (!input.planesAcross())
        for (const boundary::Wall& wall : input.flow.walls)
            slack += std::lround(0.25 * wall.surface->area() * input.spacing() / input.particleVolume());
    const long displaced = std::lround(nodeVolume / input.particleVolume());
    app.log().table({"lattice", "number", ""},
                    {{"points", std::to_string(lattice), fmt::format("{} x {} x {}", count[0], count[1], count[2])},
                     {"fluid particles", std::to_string(fluid), ""},
                     {"displaced by nodes", std::to_string(displaced), fmt::format("{} nodes", nodes)},
                     {"in bodies", std::to_string(bodies), ""},
                     {"wall particles", std::to_string(walls), fmt::format("{} layers each", input.wallLayers())}});
    json["lattice"] = {{"points", lattice}, {"fluid", fluid},   {"displaced", displaced},
                       {"walls", walls},    {"bodies", bodies}, {"nodes", nodes}};
    if (std::abs(static_cast<long>(fluid + bodies) + displaced - lattice) > slack)
        faults.push_back(
            fmt::format("0/fluid.vtp has {} particles, but the lattice less what bodies hold and nodes displace {}: "
                        "run particleFill again",
                        fluid, lattice - displaced - static_cast<long>(bodies)));
    if (std::abs(static_cast<long>(walls) - wantedWalls) > slack)
        faults.push_back(fmt::format("0/walls.vtp has {} particles, but the case needs {}: run particleFill again",
                                     walls, wantedWalls));
}

// Counts faulty particles and describes the first.
struct Wrong {
    long count = 0;
    std::string first;
    void add(const io::PolyData& fluid, std::size_t i, const std::string& what) {
        const Vec3 x = 1e6 * fluid.points[i];
        if (count++ == 0)
            first = fmt::format("particle {} at ({:.4g}, {:.4g}, {:.4g}) um, {}", fluid.point.integer("id")[i], x[0],
                                x[1], x[2], what);
    }
};

// `side` numbers cells only, since bodies hold no fluid. The sides that particleFill found by one inside test are
// compared with those of another (sidesByRays.hpp), and the number of particles in each cell with its volume. The
// meshes have to be closed surfaces, clear of each other.
void checkSides(Application& app, const Case& input, const std::vector<TriangleMesh>& meshes, const io::PolyData& fluid,
                const std::vector<Vec3>& ofBodies, ordered_json& json, Faults& faults) {
    const particles::Box box = input.fluidBox();
    const Periodicity period = box.periodicity();
    const auto out = std::count_if(fluid.points.begin(), fluid.points.end(), [&](const Vec3& x) {
        return particles::distanceSquared(x, box.low, box.high) > 0 || input.flow.walls.distance(x) < 0;
    });
    if (out > 0) faults.push_back(fmt::format("{} fluid particles lie outside the box or behind a wall", out));
    const std::vector<geometry::RaySide> rays = geometry::sidesByRays(fluid.points, meshes, box.low, box.high, period);
    const auto& written = fluid.point.integer("side");
    Wrong wrong, differ, twice;
    std::vector<long> inside(meshes.size() + 1, 0);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        ++inside[static_cast<std::size_t>(rays[i].mesh)];
        if (rays[i].isInSeveral) twice.add(fluid, i, fmt::format("side {}", written[i]));
        if (!rays[i].onSurface && rays[i].mesh != written[i])
            wrong.add(fluid, i, fmt::format("side {} in 0/fluid.vtp, {} by a ray", written[i], rays[i].mesh));
    }
    const std::vector<int> columns = geometry::tagSides(fluid.points, meshes, period);
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (!rays[i].onSurface && rays[i].mesh != columns[i])
            differ.add(fluid, i, fmt::format("side {} by columns, {} by a ray", columns[i], rays[i].mesh));
    if (wrong.count > 0)
        faults.push_back(fmt::format("{} fluid particles have the wrong side (first: {}): run particleFill again",
                                     wrong.count, wrong.first));
    if (differ.count > 0)
        faults.push_back(
            fmt::format("the two inside tests differ on {} fluid particles (first: {}): one of them "
                        "fails on this mesh; please report it with the case",
                        differ.count, differ.first));
    if (twice.count > 0)
        faults.push_back(fmt::format("{} fluid particles lie in two cells, or in a cell and its own image (first: {})",
                                     twice.count, twice.first));
    json["sides"] = {{"outside", inside[0]}, {"wrong", wrong.count}, {"differ", differ.count}};

    const std::vector<geometry::RaySide> solid = geometry::sidesByRays(ofBodies, meshes, box.low, box.high, period);
    std::vector<std::vector<std::string>> rows;
    for (std::size_t c = 0; c < meshes.size(); ++c) {
        const std::string name = input.nameOf(static_cast<int>(c) + 1);
        const double dx = input.spacing(), V = input.particleVolume(), area = meshes[c].area();
        const auto bodies = std::count_if(
            solid.begin(), solid.end(), [&](const geometry::RaySide& s) { return s.mesh == static_cast<int>(c) + 1; });
        // If nodes are particles, half of the volume of each node lies inside.
        const double found = static_cast<double>(inside[c + 1] + bodies),
                     expected = (meshes[c].volume() - (input.numerics.isImmersed() ? 0 : 0.5 * area * dx)) / V,
                     tolerance = facesOffLattice * area / (dx * dx) + 2;
        rows.push_back({name, fmt::format("{:.0f}", found), fmt::format("{:.1f}", std::max(0.0, expected)),
                        fmt::format("{:+.2f} %", 100 * (found / expected - 1))});
        json["sides"]["inside"][name] = inside[c + 1];
        json["sides"]["expected"][name] = expected;
        if (std::abs(found - std::max(0.0, expected)) > tolerance)
            faults.push_back(
                fmt::format("in the cell '{}' there are {:.0f} particles, but its volume asks for {:.0f} "
                            "(a lattice can be off by {:.0f}): run particleFill again",
                            name, found, std::max(0.0, expected), tolerance));
    }
    if (!rows.empty()) app.log().table({"particles inside", "number", "by volume", "difference"}, rows);
}

void checkDistances(Application& app, const Case& input, const utilities::Members& members, ordered_json& json,
                    Faults& faults) {
    const double dx = input.spacing();
    const utilities::Shortest shortest =
        utilities::shortestDistances(members, input.particleBox(), dx, dx, app.communicator().handle());
    std::vector<std::vector<std::string>> rows;
    const auto check = [&](const char* what, double distance, double least, bool exists) {
        if (!exists) return;
        rows.push_back({what, fmt::format("{:.3f}", distance / dx), fmt::format("{:.2f}", least)});
        json["shortest_dx"][what] = distance / dx;
        if (distance < least * dx)
            faults.push_back(
                fmt::format("overlap: {} are {:.3f} dx apart, less than {:.2f} dx", what, distance / dx, least));
    };
    check("two fluid particles", shortest.fluidFluid, leastDistance, true);
    check("fluid and wall particle", shortest.fluidWall, leastDistance, !members.walls.empty());
    check("fluid and body particle", shortest.fluidBody, leastDistance, !members.bodies.empty());
    check("fluid particle and node", shortest.fluidNode, leastNodeDistance,
          !members.cells.empty() && !input.numerics.isImmersed());
    check("nodes of two cells", shortest.cellCell, leastCellDistance, members.cells.size() > 1);
    app.log().table({"shortest distance", "dx", "at least"}, rows);
}

}  // namespace

int main(int argc, char* argv[]) {
    Application app("checkMesh", "Checks the meshes and particles that stand in 0/ of a case.", argc, argv,
                    {.samples = {"checkMesh -case tutorials/rbcShear/Ca0.02", "checkMesh -json"}});
    return app.run([&] {
        utilities::requireSerial(app);
        const Case input = Case::read(app);
        ordered_json json = ordered_json::object();
        Faults faults;
        utilities::Members members;
        const std::vector<TriangleMesh> ofTypes = utilities::readCellMeshes(input);
        const bool areCellsSound = checkCells(app, input, ofTypes, json, faults);
        const std::vector<TriangleMesh> meshes = utilities::placedCells(input, ofTypes);
        for (const TriangleMesh& mesh : meshes) members.cells.push_back(mesh.nodes);
        const std::vector<TriangleMesh> bodies = utilities::readBodyMeshes(input);
        // Inside and outside are defined for closed surfaces only.
        const bool areSound = checkBodies(app, input, bodies, json, faults) && areCellsSound;
        bool areClear = areSound;
        if (areSound)
            for (const Problem& p : simulation::misplaced(input, simulation::placedOf(input, meshes, bodies))) {
                faults.push_back(p.text());
                areClear = false;
            }

        if (!(meshes.empty() && bodies.empty()) && !std::filesystem::exists(simulation::startFile(input, "fluid"))) {
            app.log().info(
                "0/fluid.vtp is not there yet: only the meshes are checked; run particleFill, then checkMesh again");
        } else {
            const io::PolyData fluid = simulation::readStart(input, "fluid");
            members.fluid = fluid.points;
            if (input.flow.walls.exist()) members.walls = simulation::readStart(input, "walls").points;
            if (!bodies.empty()) members.bodies = simulation::readStart(input, "bodies").points;
            checkLattice(app, input, meshes, members.fluid.size(), members.walls.size(), members.bodies.size(), json,
                         faults);
            if (areClear)
                checkSides(app, input, meshes, fluid, members.bodies, json, faults);
            else
                app.log().info("sides are not checked: the meshes are not sound, or not clear of each other");
            checkDistances(app, input, members, json, faults);
        }

        json["failed"] = faults;
        if (app.json()) std::cout << json.dump(2) << '\n';
        if (faults.empty()) {
            app.log().info("Mesh OK.");
            return ExitCode::done;
        }
        for (const std::string& fault : faults) app.log().error("{}", fault);
        app.log().error("{} check{} failed.", faults.size(), faults.size() == 1 ? "" : "s");
        return ExitCode::invalidCase;
    });
}
