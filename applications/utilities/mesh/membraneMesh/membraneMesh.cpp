// membraneMesh: meshes every type of cell and every rigid body of system/mesh.yaml and writes them to 0/<name>.vtp. The
// mesh of a type with `places` or `table` is centred on the origin; that of a single cell or body stands at its place.
//
// Nodes lie exactly on the surface of the shape. The mesh of a cell is the stress-free state of its membrane; that of a
// body gives its volume and inertia. Prints the quality of each mesh, and the moduli of the network beside the closed
// form that is used to compute Ca. Surfaces of the same shape and edge length are meshed once.
//
// Sample runs:
//     membraneMesh -case tutorials/rbcShear/Ca0.02
//     membraneMesh -case tutorials/rbcShear/Ca0.02 -set 'system/mesh.yaml:/cells/0/edge=0.3 um'
#include <nlohmann/json.hpp>

#include <chrono>
#include <iostream>
#include <numeric>

#include "../cellMeshes.hpp"
#include "geometry/enclosedVolume.hpp"
#include "simulation/dictionaries.hpp"
#include "simulation/placement.hpp"

using namespace corpuscle;
using geometry::TriangleMesh;

namespace {

// Surfaces are of the same kind if shape, settings of the shape, edge length and `enclose` agree.
std::string kindOf(const simulation::SurfaceSettings& surface) {
    return emit(writeChoice(surface.shape)) + fmt::format("{:a} {}", surface.edge, surface.enclose);
}

void writeSurface(const simulation::Case& input, const std::string& name, const TriangleMesh& mesh) {
    io::PolyData data;
    data.points = mesh.nodes;
    data.triangles = mesh.triangles;
    auto& id = data.point.integers["id"];
    id.resize(mesh.nodes.size());
    std::iota(id.begin(), id.end(), 0);
    data.point.scalars["spacing"].assign(mesh.nodes.size(), input.spacing());
    simulation::writeStart(input, name, std::move(data));
}

TriangleMesh meshOf(const simulation::SurfaceSettings& surface, const std::string& what) {
    try {
        return geometry::meshEnclosing(*surface.shape, surface.edge, surface.enclosesExactly());
    } catch (const Failure& fault) {
        throw Failure(fault.code(),
                      fmt::format("{} '{}', shape and edge in system/mesh.yaml: {}", what, surface.name, fault.what()));
    }
}

class Meshes {
  public:
    Meshes(Application& app, const simulation::Case& input) : app_(app), input_(input) {}

    // Meshes, places and writes one surface; `describe` returns the lines on its mesh that depend on its use as a cell
    // or body.
    TriangleMesh make(const simulation::SurfaceSettings& surface, const std::string& what,
                      const std::function<std::string(const TriangleMesh&)>& describe, nlohmann::ordered_json& json) {
        const auto begin = std::chrono::steady_clock::now();
        const bool isNew = !made_.contains(kindOf(surface));
        if (isNew)
            for (const std::string& remark : surface.shape->remarks()) app_.log().info("{}", remark);
        if (isNew) made_[kindOf(surface)] = meshOf(surface, what);
        TriangleMesh mesh = made_.at(kindOf(surface));
        const geometry::MeshQuality quality = geometry::meshQuality(mesh, surface.shape.model.get());
        json[surface.name] = {{"quality", utilities::toJson(quality)}};
        const std::string description = describe(mesh);
        utilities::place(mesh, surface);
        if (const auto faults = geometry::checkClosedManifold(mesh); !faults.empty())
            throw Failure(ExitCode::numerics, "the mesh of the " + what + " '" + surface.name +
                                                  "' is not sound: " + joinWords(faults, "; ") +
                                                  ". Take a smaller edge in system/mesh.yaml");
        writeSurface(input_, surface.name, mesh);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        if (isNew)
            app_.log().info("{} {}: {}, edge {}, written to 0/{}.vtp in {:.2f} s\n{}\n{}", what, surface.name,
                            surface.shape.name, formatQuantity(surface.edge, unit::metre), surface.name, seconds,
                            utilities::indented(quality.text()), utilities::indented(description));
        else
            app_.log().info("{} {}: the same mesh at its own place, written to 0/{}.vtp", what, surface.name,
                            surface.name);
        json[surface.name]["seconds"] = seconds;
        return mesh;
    }

  private:
    Application& app_;
    const simulation::Case& input_;
    std::map<std::string, TriangleMesh> made_;
};

}  // namespace

int main(int argc, char* argv[]) {
    Application app("membraneMesh", "Meshes the cells and rigid bodies of a case and writes them to 0/.", argc, argv,
                    {.samples = {"membraneMesh -case tutorials/rbcShear/Ca0.02",
                                 "membraneMesh -set 'system/mesh.yaml:/cells/0/edge=0.3 um'"}});
    return app.run([&] {
        utilities::requireSerial(app);
        app.announce();
        const simulation::Case input = simulation::Case::read(app);
        simulation::requireStartWritable(app.communicator(), input);
        app.lockCase();
        app.openLog();
        simulation::refreshSchemas(app);
        nlohmann::ordered_json json = nlohmann::ordered_json::object();
        Meshes meshes(app, input);
        std::vector<TriangleMesh> cells, bodies;
        for (const simulation::CellSettings& cell : input.mesh.cells)
            cells.push_back(meshes.make(
                cell, "cell",
                [&](const TriangleMesh& mesh) {
                    const membrane::NetworkModuli moduli = utilities::moduliOf(mesh, input.membraneOf(cell));
                    json[cell.name]["moduli"] = utilities::toJson(moduli);
                    return membrane::describe(moduli);
                },
                json));
        for (const simulation::BodyPlaceSettings& body : input.mesh.bodies)
            bodies.push_back(meshes.make(
                body, "body",
                [&](const TriangleMesh& mesh) {
                    const bodies::Solid solid(mesh, input.densityOf(body));
                    json[body.name]["solid"] = utilities::toJson(solid);
                    return utilities::describe(solid);
                },
                json));
        const std::vector<TriangleMesh> placed = utilities::placedCells(input, cells);
        for (const Problem& fault : simulation::misplaced(input, simulation::placedOf(input, placed, bodies)))
            app.log().warning("{}", fault.text());
        if (cells.empty() && bodies.empty())
            app.log().info("system/mesh.yaml has neither cells nor bodies: nothing to mesh");
        app.log().info("Next: particleFill{}", std::filesystem::exists(simulation::startFile(input, "fluid"))
                                                   ? "; 0/fluid.vtp stems from the meshes before these"
                                                   : "");
        if (app.json()) std::cout << json.dump(2) << '\n';
        return ExitCode::done;
    });
}
