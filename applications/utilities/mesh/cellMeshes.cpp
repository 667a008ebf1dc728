#include "cellMeshes.hpp"
#include "simulation/placement.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace corpuscle::utilities {

using geometry::TriangleMesh;
using simulation::Case;
using simulation::SurfaceSettings;

void requireSerial(const Application& app) {
    if (app.communicator().size() > 1)
        throw Failure(ExitCode::usage, fmt::format("runs on one rank, but {} were started: run it without mpirun",
                                                   app.communicator().size()));
}

void place(TriangleMesh& mesh, const SurfaceSettings& surface) {
    mesh.rotate(geometry::rotationFromZ(surface.axis));
    mesh.translate(surface.centre);
}

TriangleMesh inShapeFrame(TriangleMesh mesh, const SurfaceSettings& surface) {
    mesh.translate(-surface.centre);
    mesh.rotate(geometry::rotationFromZ(surface.axis).transpose());
    return mesh;
}

namespace {

template <class Surfaces>
std::vector<TriangleMesh> readMeshes(const Case& input, const Surfaces& surfaces) {
    std::vector<TriangleMesh> meshes;
    for (const SurfaceSettings& surface : surfaces) {
        io::PolyData data = simulation::readStart(input, surface.name);
        meshes.push_back({std::move(data.points), std::move(data.triangles)});
    }
    return meshes;
}

}  // namespace

std::vector<TriangleMesh> readCellMeshes(const Case& input) { return readMeshes(input, input.mesh.cells); }
std::vector<TriangleMesh> placedCells(const Case& input, const std::vector<TriangleMesh>& ofTypes) {
    std::vector<TriangleMesh> cells;
    for (std::size_t type = 0; type < ofTypes.size(); ++type)
        for (const geometry::Place& place : input.mesh.cells[type].placed)
            cells.push_back({place.of(ofTypes[type].nodes), ofTypes[type].triangles});
    return cells;
}
std::vector<TriangleMesh> readBodyMeshes(const Case& input) { return readMeshes(input, input.mesh.bodies); }

void requireClear(const Case& input, const std::vector<TriangleMesh>& cells, const std::vector<TriangleMesh>& bodies) {
    Problems problems;
    for (const Problem& p : simulation::misplaced(input, simulation::placedOf(input, cells, bodies)))
        problems.add(p.mark, p.key, p.message + ", then run membraneMesh again");
    input.throwIfAny(problems);
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

nlohmann::ordered_json toJson(const bodies::Solid& solid) {
    return {{"volume_m3", solid.volume},
            {"mass_kg", solid.mass},
            {"inertia_kgm2", {solid.inertia[0], solid.inertia[1], solid.inertia[2]}}};
}

std::string describe(const bodies::Solid& solid) {
    const Vec3& I = solid.inertia;
    return fmt::format("volume {:.6g} m^3, mass {:.6g} kg, principal moments of inertia {:.6g}, {:.6g}, {:.6g} kg m^2",
                       solid.volume, solid.mass, I[0], I[1], I[2]);
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
