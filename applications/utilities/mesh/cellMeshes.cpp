#include "cellMeshes.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace corpuscle::utilities {

using geometry::TriangleMesh;
using simulation::Case;
using simulation::CellSettings;

void requireSerial(const Application& app) {
    if (app.communicator().size() > 1)
        throw Failure(ExitCode::usage, fmt::format("runs on one rank, but {} were started: run it without mpirun",
                                                   app.communicator().size()));
}

void place(TriangleMesh& mesh, const CellSettings& cell) {
    mesh.rotate(geometry::rotationFromZ(cell.axis));
    mesh.translate(cell.centre);
}

TriangleMesh inShapeFrame(TriangleMesh mesh, const CellSettings& cell) {
    mesh.translate(-cell.centre);
    mesh.rotate(geometry::rotationFromZ(cell.axis).transpose());
    return mesh;
}

std::vector<TriangleMesh> readCellMeshes(const Case& input) {
    std::vector<TriangleMesh> meshes;
    for (const CellSettings& cell : input.mesh.cells) {
        io::PolyData data = simulation::readStart(input, cell.name);
        meshes.push_back({std::move(data.points), std::move(data.triangles)});
    }
    return meshes;
}

geometry::Period periodOf(const particles::Box& box) {
    geometry::Period period = box.size();
    for (int k = 0; k < 3; ++k)
        if (!box.periodic[static_cast<std::size_t>(k)]) period[k] = 0;
    return period;
}

std::vector<std::string> misplacedCells(const Case& input, const std::vector<TriangleMesh>& meshes) {
    std::vector<std::string> faults;
    const particles::Box box = input.fluidBox();
    const auto& cells = input.mesh.cells;
    for (std::size_t c = 0; c < meshes.size(); ++c) {
        Vec3 low = meshes[c].nodes.front(), high = low;
        for (const Vec3& x : meshes[c].nodes) low = low.cwiseMin(x), high = high.cwiseMax(x);
        for (int k = 0; k < 3; ++k) {
            const char axis = "xyz"[k];
            if (box.periodic[static_cast<std::size_t>(k)] ? high[k] - low[k] > box.size()[k]
                                                          : low[k] < box.low[k] || high[k] > box.high[k])
                faults.push_back(fmt::format(
                    "the cell '{}' reaches from {} to {} along {}, and the box from {} to {}", cells[c].name,
                    formatQuantity(low[k], unit::metre), formatQuantity(high[k], unit::metre), axis,
                    formatQuantity(box.low[k], unit::metre), formatQuantity(box.high[k], unit::metre)));
        }
        for (std::size_t other = 0; other < meshes.size(); ++other) {
            if (other == c) continue;
            const std::vector<int> side = geometry::tagSides(meshes[other].nodes, {meshes[c]}, periodOf(box));
            if (const auto inside = std::count(side.begin(), side.end(), 1))
                faults.push_back(fmt::format("{} nodes of the cell '{}' lie inside the cell '{}'", inside,
                                             cells[other].name, cells[c].name));
        }
    }
    return faults;
}

membrane::NetworkModuli moduliOf(const TriangleMesh& mesh, const membrane::MembraneSettings& laws) {
    return membrane::measureModuli(membrane::Network(mesh.nodes, mesh.triangles), laws);
}

nlohmann::ordered_json toJson(const geometry::MeshQuality& q) {
    return {{"nodes", q.nodes},           {"edges", q.edges},       {"triangles", q.triangles},
            {"euler", q.euler},           {"closed", q.closed},     {"edgeMin_m", q.edgeMin},
            {"edgeMean_m", q.edgeMean},   {"edgeMax_m", q.edgeMax}, {"angleMin_deg", q.angleMin},
            {"angleMax_deg", q.angleMax}, {"valence", q.valence},   {"area_m2", q.area},
            {"areaError", q.areaError},   {"volume_m3", q.volume},  {"volumeError", q.volumeError},
            {"residual", q.residual}};
}

nlohmann::ordered_json toJson(const membrane::NetworkModuli& m) {
    return {{"Gs_N_m", m.shear},
            {"Ks_N_m", m.area},
            {"GsClosedForm_N_m", m.closedForm.shear},
            {"KsClosedForm_N_m", m.closedForm.area},
            {"deviation", m.deviation},
            {"shearAnisotropy", m.shearAnisotropy},
            {"axialAnisotropy", m.axialAnisotropy}};
}

std::string indented(const std::string& lines) {
    std::string text;
    for (std::size_t begin = 0; begin < lines.size();) {
        const std::size_t end = std::min(lines.find('\n', begin), lines.size());
        text += (text.empty() ? "  " : "\n  ") + lines.substr(begin, end - begin);
        begin = end + 1;
    }
    return text;
}

}  // namespace corpuscle::utilities
