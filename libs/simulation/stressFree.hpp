// The stress-free shape of a membrane: its mesh as made, or another shape of the same triangles, from a file that the
// case names
//     rbc: {stressFree: constant/stressFree.vtp}
// This is a VTP file in metres, with nodes and triangles in the order of the mesh; where it lies does not matter.
// membraneRelax makes one from the mesh, such as the cell inflated to a spheroid (docs/membrane.md).
#pragma once
#include <filesystem>
#include <string>

#include "core/error.hpp"
#include "geometry/triangleMesh.hpp"
#include "membrane/membraneSettings.hpp"

namespace corpuscle::simulation {

// Nodes of the stress-free shape of `mesh` under the laws of `type` in constant/membranes.yaml. If the file cannot be
// read or belongs to another mesh, adds a problem and returns the nodes of `mesh`.
std::vector<Vec3> stressFreeNodes(const std::filesystem::path& caseDirectory, const std::string& type,
                                  const membrane::MembraneSettings& laws, const geometry::TriangleMesh& mesh,
                                  Problems& problems);

}  // namespace corpuscle::simulation
