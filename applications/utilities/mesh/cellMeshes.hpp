// The meshes of cells and rigid bodies in 0/: functions that membraneMesh, particleFill and checkMesh share.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "geometry/mesher.hpp"
#include "membrane/moduli.hpp"
#include "simulation/startFiles.hpp"

namespace corpuscle::utilities {

// These programs are serial: throws Failure(usage) under mpirun with more than one rank.
void requireSerial(const Application& app);

// Moves a mesh from the frame of its shape (axis along z, centre at the origin) to its place, and back.
void place(geometry::TriangleMesh& mesh, const simulation::SurfaceSettings& surface);
geometry::TriangleMesh inShapeFrame(geometry::TriangleMesh mesh, const simulation::SurfaceSettings& surface);

// The mesh of each type of cell, as stored in 0/. Throws as simulation::readStart.
std::vector<geometry::TriangleMesh> readCellMeshes(const simulation::Case& input);
// All cells in the order of their numbers, each at its place, made from the meshes of their types.
std::vector<geometry::TriangleMesh> placedCells(const simulation::Case& input,
                                                const std::vector<geometry::TriangleMesh>& ofTypes);
std::vector<geometry::TriangleMesh> readBodyMeshes(const simulation::Case& input);
// Throws CaseError if cells, bodies or walls are not clear of each other (simulation/placement.hpp).
void requireClear(const simulation::Case& input, const std::vector<geometry::TriangleMesh>& cells,
                  const std::vector<geometry::TriangleMesh>& bodies);

membrane::NetworkModuli moduliOf(const geometry::TriangleMesh& mesh, const membrane::MembraneSettings& laws);

nlohmann::ordered_json toJson(const geometry::MeshQuality& quality);
nlohmann::ordered_json toJson(const membrane::NetworkModuli& moduli);
nlohmann::ordered_json toJson(const bodies::Solid& solid);
std::string describe(const bodies::Solid& solid);

std::string indented(const std::string& lines);

}  // namespace corpuscle::utilities
