// Triangulated surface from a file: STL, OFF, PLY or VTP, by the file's ending. Coordinates as written. Nodes at the
// same place are made one (STL repeats them for each triangle), polygons are cut into triangles, and the whole is
// turned outwards. Throws Failure(io) for a file that cannot be read.
#pragma once
#include <filesystem>

#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

TriangleMesh readSurface(const std::filesystem::path& file);

}  // namespace corpuscle::geometry
