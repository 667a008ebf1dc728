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

// The mesh of each type of cell, as it stands in 0/. Throws as simulation::readStart.
std::vector<geometry::TriangleMesh> readCellMeshes(const simulation::Case& input);
// All cells by their numbers, each where it is put, from the meshes of their types.
std::vector<geometry::TriangleMesh> placedCells(const simulation::Case& input,
                                                const std::vector<geometry::TriangleMesh>& ofTypes);
std::vector<geometry::TriangleMesh> readBodyMeshes(const simulation::Case& input);

membrane::NetworkModuli moduliOf(const geometry::TriangleMesh& mesh, const membrane::MembraneSettings& laws);

nlohmann::ordered_json toJson(const geometry::MeshQuality& quality);
nlohmann::ordered_json toJson(const membrane::NetworkModuli& moduli);
nlohmann::ordered_json toJson(const bodies::Solid& solid);
std::string describe(const bodies::Solid& solid);

std::string indented(const std::string& lines);

}  // namespace corpuscle::utilities
