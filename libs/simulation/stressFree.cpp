#include "simulation/stressFree.hpp"

#include <fmt/format.h>

#include "io/polyData.hpp"

namespace corpuscle::simulation {

std::vector<Vec3> stressFreeNodes(const std::filesystem::path& caseDirectory, const std::string& type,
                                  const membrane::MembraneSettings& laws, const geometry::TriangleMesh& mesh,
                                  Problems& problems) {
    if (!laws.stressFree) return mesh.nodes;
    const auto refuse = [&](const std::string& message) {
        problems.add({"constant/membranes.yaml", 0, 0}, type + ".stressFree", message);
        return mesh.nodes;
    };
    io::PolyData shape;
    try {
        shape = io::readVtp(caseDirectory / *laws.stressFree);
    } catch (const Failure& fault) {
        return refuse(fault.what());
    }
    if (shape.points.size() != mesh.nodes.size() || shape.triangles.size() != mesh.triangles.size())
        return refuse(fmt::format(
            "found {} with {} nodes and {} triangles, but the cell's mesh has {} and {}; the stress-free shape is "
            "one of the same mesh: make it from this mesh with membraneRelax",
            *laws.stressFree, shape.points.size(), shape.triangles.size(), mesh.nodes.size(), mesh.triangles.size()));
    if (shape.triangles != mesh.triangles)
        return refuse(fmt::format(
            "found {}, whose triangles have other nodes than those of the cell's mesh; the stress-free shape is one "
            "of the same mesh: make it from this mesh with membraneRelax",
            *laws.stressFree));
    return std::move(shape.points);
}

}  // namespace corpuscle::simulation
