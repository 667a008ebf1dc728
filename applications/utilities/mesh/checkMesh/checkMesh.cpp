// checkMesh: whether what stands in 0/ is sound and belongs to the case.
//
// Cells and rigid bodies: closed, on their shape, with the wanted edges, in the box and not in each other. Particles: on the lattice's count, sides
// right by an inside test, none on top of another. Reads only; ends with "Mesh OK." or with what failed, exit code 2.
//
// Sample runs:
//     checkMesh -case tutorials/rbcShear/Ca0.02
//     checkMesh -case tutorials/rbcShear/Ca0.02 -json
#include <iostream>
#include <nlohmann/json.hpp>

#include "../cellMeshes.hpp"
#include "neighbours.hpp"
#include "simulation/sceneBuilder.hpp"

using namespace corpuscle;
using geometry::TriangleMesh;
using nlohmann::ordered_json;
using simulation::Case;

namespace {

constexpr double leastAngle = 20;           // degrees
constexpr double edgeTolerance = 0.05;      // of the mean edge, relative
constexpr double surfaceTolerance = 1e-6;   // of nodes from the shape, over the radius
constexpr double leastDistance = 0.25;      // of two particles, in spacings
constexpr double leastNodeDistance = 0.1;   // of a fluid particle and a node
constexpr double leastCellDistance = 0.25;  // of the nodes of two cells

using Faults = std::vector<std::string>;

geometry::MeshQuality checkSurface(const simulation::SurfaceSettings& surface, const TriangleMesh& mesh,
                                   const std::function<void(const std::string&)>& fault) {
    geometry::MeshQuality quality =
        geometry::meshQuality(utilities::inShapeFrame(mesh, surface), surface.shape.model.get());
    for (const std::string& text : geometry::checkClosedManifold(mesh)) fault(text);
    if (quality.euler != 2)
        fault(fmt::format("Euler characteristic {} instead of 2: not one surface without handles", quality.euler));
    if (quality.angleMin < leastAngle)
        fault(fmt::format("smallest angle {:.1f} degrees, below {}", quality.angleMin, leastAngle));
    if (std::abs(quality.edgeMean / surface.edge - 1) > edgeTolerance)
        fault(fmt::format("mean edge {}, but system/mesh.yaml asks for {}: run membraneMesh again",
                          formatQuantity(quality.edgeMean, unit::metre), formatQuantity(surface.edge, unit::metre)));
    if (!(quality.residual <= surfaceTolerance))
        fault(fmt::format("nodes lie up to {:.2g} radii off the shape of system/mesh.yaml: run membraneMesh again",
                          quality.residual));
    return quality;
}

void checkCells(Application& app, const Case& input, const std::vector<TriangleMesh>& meshes, ordered_json& json,
                Faults& faults) {
    for (std::size_t c = 0; c < meshes.size(); ++c) {
        const simulation::CellSettings& cell = input.mesh.cells[c];
        const auto fault = [&](const std::string& text) { faults.push_back("cell '" + cell.name + "': " + text); };
        const geometry::MeshQuality quality = checkSurface(cell, meshes[c], fault);
        app.log().info("cell {}\n{}", cell.name, utilities::indented(quality.text()));
        json["cells"][cell.name] = {{"quality", utilities::toJson(quality)}};
        try {
            const membrane::NetworkModuli moduli = utilities::moduliOf(meshes[c], input.membraneOf(cell));
            app.log().info("{}", utilities::indented(membrane::describe(moduli)));
            json["cells"][cell.name]["moduli"] = utilities::toJson(moduli);
        } catch (const Failure& failure) {  // no network can be made of it
            fault(failure.what());
        }
    }
}

void checkBodies(Application& app, const Case& input, const std::vector<TriangleMesh>& meshes, ordered_json& json,
                 Faults& faults) {
    for (std::size_t b = 0; b < meshes.size(); ++b) {
        const simulation::BodyPlaceSettings& body = input.mesh.bodies[b];
        const geometry::MeshQuality quality = checkSurface(
            body, meshes[b], [&](const std::string& text) { faults.push_back("body '" + body.name + "': " + text); });
        const bodies::Solid solid(meshes[b], input.densityOf(body));
        app.log().info("body {}\n{}\n{}", body.name, utilities::indented(quality.text()),
                       utilities::indented(utilities::describe(solid)));
        json["bodies"][body.name] = {{"quality", utilities::toJson(quality)}, {"solid", utilities::toJson(solid)}};
    }
}

// The number of lattice points is that of the fluid, of the bodies, and of the fluid that the nodes displace.
void checkLattice(Application& app, const Case& input, const std::vector<TriangleMesh>& meshes, std::size_t fluid,
                  std::size_t walls, std::size_t bodies, ordered_json& json, Faults& faults) {
    long count[3], lattice = 1, layer = 1;
    double nodeVolume = 0;
    std::size_t nodes = 0;
    for (const TriangleMesh& mesh : meshes) {
        nodes += mesh.nodes.size();
        if (!input.numerics.isImmersed())
            for (const double volume : simulation::nodeVolumes(mesh.vertexAreas(), input.spacing()))
                nodeVolume += volume;
    }
    for (int k = 0; k < 3; ++k) {
        lattice *= count[k] = std::lround(input.mesh.domain.size[k] / input.spacing());
        if (k != input.flowModel->wallAxis()) layer *= count[k];
    }
    const long displaced = std::lround(nodeVolume / input.particleVolume()),
               wantedWalls = 2 * layer * input.wallLayers();
    app.log().table({"lattice", "number", ""},
                    {{"points", std::to_string(lattice), fmt::format("{} x {} x {}", count[0], count[1], count[2])},
                     {"fluid particles", std::to_string(fluid), ""},
                     {"displaced by nodes", std::to_string(displaced), fmt::format("{} nodes", nodes)},
                     {"in bodies", std::to_string(bodies), ""},
                     {"wall particles", std::to_string(walls), fmt::format("{} layers each", input.wallLayers())}});
    json["lattice"] = {{"points", lattice}, {"fluid", fluid},   {"displaced", displaced},
                       {"walls", walls},    {"bodies", bodies}, {"nodes", nodes}};
    if (static_cast<long>(fluid + bodies) + displaced != lattice)
        faults.push_back(
            fmt::format("0/fluid.vtp has {} particles, but the lattice less what bodies hold and nodes displace {}: "
                        "run particleFill again",
                        fluid, lattice - displaced - static_cast<long>(bodies)));
    if (static_cast<long>(walls) != wantedWalls)
        faults.push_back(fmt::format("0/walls.vtp has {} particles, but the case needs {}: run particleFill again",
                                     walls, wantedWalls));
}

void checkSides(const Case& input, const std::vector<TriangleMesh>& meshes, const io::PolyData& fluid,
                ordered_json& json, Faults& faults) {
    const particles::Box box = input.fluidBox();
    // Sides are those of cells: bodies hold no fluid.
    const auto out = std::count_if(fluid.points.begin(), fluid.points.end(),
                                   [&](const Vec3& x) { return particles::distanceSquared(x, box.low, box.high) > 0; });
    if (out > 0) faults.push_back(fmt::format("{} fluid particles lie outside the box", out));
    const std::vector<int> side = geometry::tagSides(fluid.points, meshes, utilities::periodOf(box));
    const auto& written = fluid.point.integer("side");
    long wrong = 0;
    for (std::size_t i = 0; i < side.size(); ++i) wrong += side[i] != written[i];
    if (wrong > 0)
        faults.push_back(
            fmt::format("{} fluid particles have the wrong side by the inside test: run particleFill again", wrong));
    std::vector<long> inside(meshes.size() + 1, 0);
    for (const int s : side) ++inside[static_cast<std::size_t>(s)];
    json["sides"] = {{"outside", inside[0]}, {"wrong", wrong}};
    for (std::size_t c = 0; c < meshes.size(); ++c) json["sides"]["inside"][input.mesh.cells[c].name] = inside[c + 1];
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
        const std::vector<TriangleMesh> meshes = utilities::readCellMeshes(input);
        for (const TriangleMesh& mesh : meshes) members.cells.push_back(mesh.nodes);
        checkCells(app, input, meshes, json, faults);
        const std::vector<TriangleMesh> bodies = utilities::readBodyMeshes(input);
        checkBodies(app, input, bodies, json, faults);
        for (const std::string& text : utilities::misplaced(input, meshes, bodies)) faults.push_back(text);

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
            checkSides(input, meshes, fluid, json, faults);
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
