// The meshes of cells and rigid bodies as they stand in 0/: what membraneMesh, particleFill and checkMesh have in
// common.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "geometry/mesher.hpp"
#include "membrane/moduli.hpp"
#include "simulation/startFiles.hpp"

namespace corpuscle::utilities {

// These programs run alone: Failure(usage) under mpirun with more ranks than one.
void requireSerial(const Application& app);

// From the shape's frame (axis along z, centre at the origin) to its place, and back.
void place(geometry::TriangleMesh& mesh, const simulation::SurfaceSettings& surface);
geometry::TriangleMesh inShapeFrame(geometry::TriangleMesh mesh, const simulation::SurfaceSettings& surface);

// All cells of the case, in its order. Throws as simulation::readStart.
std::vector<geometry::TriangleMesh> readCellMeshes(const simulation::Case& input);
std::vector<geometry::TriangleMesh> readBodyMeshes(const simulation::Case& input);

membrane::NetworkModuli moduliOf(const geometry::TriangleMesh& mesh, const membrane::MembraneSettings& laws);

nlohmann::ordered_json toJson(const geometry::MeshQuality& quality);
nlohmann::ordered_json toJson(const membrane::NetworkModuli& moduli);
nlohmann::ordered_json toJson(const bodies::Solid& solid);
std::string describe(const bodies::Solid& solid);

std::string indented(const std::string& lines);

}  // namespace corpuscle::utilities
