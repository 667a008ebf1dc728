// The stress-free shape of a membrane: its mesh as made, or another shape of the same triangles, which a case names by
// file
//     rbc: {stressFree: constant/stressFree.vtp}
// a VTP in metres with nodes and triangles in the order of the mesh; where it lies does not matter. membraneRelax makes
// one from the mesh, such as the cell blown up to a spheroid (docs/membrane.md).
#pragma once
#include <filesystem>
#include <string>

#include "core/error.hpp"
#include "geometry/triangleMesh.hpp"
#include "membrane/membraneSettings.hpp"

namespace corpuscle::simulation {

// Nodes of the stress-free shape of `mesh` under the laws of `type` in constant/membranes.yaml. Adds a problem, and
// returns the mesh's own, where the file cannot be read or is a shape of another mesh.
std::vector<Vec3> stressFreeNodes(const std::filesystem::path& caseDirectory, const std::string& type,
                                  const membrane::MembraneSettings& laws, const geometry::TriangleMesh& mesh,
                                  Problems& problems);

}  // namespace corpuscle::simulation
