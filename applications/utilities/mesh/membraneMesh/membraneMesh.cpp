// membraneMesh: meshes every cell of system/mesh.yaml and writes it to 0/<cell>.vtp.
//
// Nodes lie on the exact surface; the mesh is the stress-free state of the membrane. Prints quality, and the moduli of the network
// beside the closed form that Ca is computed with. Cells of the same shape and edge length are meshed once.
//
// Sample runs:
//     membraneMesh -case tutorials/rbcShear/Ca0.02
//     membraneMesh -case tutorials/rbcShear/Ca0.02 -set 'system/mesh.yaml:/cells/0/edge=0.3 um'
#include <nlohmann/json.hpp>

#include <chrono>
#include <iostream>
#include <numeric>

#include "../cellMeshes.hpp"

using namespace corpuscle;
using geometry::TriangleMesh;

namespace {

// Cells are the same kind when shape, its settings and edge length are.
std::string kindOf(const simulation::CellSettings& cell) {
    return emit(writeChoice(cell.shape)) + fmt::format("{:a}", cell.edge);
}

void writeCell(const simulation::Case& input, const std::string& name, const TriangleMesh& mesh) {
    io::PolyData data;
    data.points = mesh.nodes;
    data.triangles = mesh.triangles;
    auto& id = data.point.integers["id"];
    id.resize(mesh.nodes.size());
    std::iota(id.begin(), id.end(), 0);
    data.point.scalars["spacing"].assign(mesh.nodes.size(), input.spacing());
    simulation::writeStart(input, name, std::move(data));
}

}  // namespace

int main(int argc, char* argv[]) {
    Application app("membraneMesh", "Meshes the cells of a case and writes them to 0/.", argc, argv,
                    {.samples = {"membraneMesh -case tutorials/rbcShear/Ca0.02",
                                 "membraneMesh -set 'system/mesh.yaml:/cells/0/edge=0.3 um'"}});
    return app.run([&] {
        utilities::requireSerial(app);
        app.openLog();
        const simulation::Case input = simulation::Case::read(app);
        nlohmann::ordered_json json = nlohmann::ordered_json::object();
        std::map<std::string, TriangleMesh> made;
        std::vector<TriangleMesh> placed;
        for (const simulation::CellSettings& cell : input.mesh.cells) {
            const auto begin = std::chrono::steady_clock::now();
            const bool isNew = !made.contains(kindOf(cell));
            if (isNew) made[kindOf(cell)] = geometry::meshSurface(*cell.shape, cell.edge);
            TriangleMesh mesh = made.at(kindOf(cell));
            const geometry::MeshQuality quality = geometry::meshQuality(mesh, cell.shape.model.get());
            const membrane::NetworkModuli moduli = utilities::moduliOf(mesh, input.membraneOf(cell));
            utilities::place(mesh, cell);
            if (const auto faults = geometry::checkClosedManifold(mesh); !faults.empty())
                throw Failure(ExitCode::numerics, "the mesh of the cell '" + cell.name +
                                                      "' is not sound: " + joinWords(faults, "; ") +
                                                      ". Take a smaller edge in system/mesh.yaml");
            writeCell(input, cell.name, mesh);
            const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
            if (isNew)
                app.log().info("cell {}: {}, edge {}, written to 0/{}.vtp in {:.2f} s\n{}\n{}", cell.name,
                               cell.shape.name, formatQuantity(cell.edge, unit::metre), cell.name, seconds,
                               utilities::indented(quality.text()), utilities::indented(membrane::describe(moduli)));
            else
                app.log().info("cell {}: the same mesh at its own place, written to 0/{}.vtp", cell.name, cell.name);
            json[cell.name] = {
                {"quality", utilities::toJson(quality)}, {"moduli", utilities::toJson(moduli)}, {"seconds", seconds}};
            placed.push_back(std::move(mesh));
        }
        for (const std::string& fault : utilities::misplacedCells(input, placed)) app.log().warning("{}", fault);
        if (input.mesh.cells.empty()) app.log().info("system/mesh.yaml has no cells: nothing to mesh");
        app.log().info("Next: particleFill{}", std::filesystem::exists(simulation::startFile(input, "fluid"))
                                                   ? "; 0/fluid.vtp stems from the meshes before these"
                                                   : "");
        if (app.json()) std::cout << json.dump(2) << '\n';
        return ExitCode::done;
    });
}
