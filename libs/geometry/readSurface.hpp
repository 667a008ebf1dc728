// Triangulated surface from a file: STL, OFF, PLY or VTP, by the file's ending. Coordinates as written.
//
// 1. Polygons are cut into triangles.
// 2. Nodes at the same place are made one (STL repeats them for each triangle). Where the surface is not closed then,
//    nodes nearer to each other than 1e-6 of its size are made one as well: some programs round each copy differently.
// 3. Triangles with two equal corners, and nodes of no triangle, are left out.
// 4. Triangles are turned to the orientation of their neighbours, and the whole outwards.
// What was done in 2 to 4 stands in `remarks`. What cannot be read throws Failure with the file, the place and what is
// wrong there: invalidCase for its content, io for a file that is missing or cannot be read.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

struct SurfaceFromFile {
    TriangleMesh mesh;
    double size = 0;                   // the longest side of its box, in units of the file
    std::vector<std::string> remarks;  // whole sentences
};

SurfaceFromFile readSurface(const std::filesystem::path& file);

// The same from the bytes of a file with the ending ".stl", ".off", ".ply" or ".vtp"; `name` is for messages.
SurfaceFromFile parseSurface(std::string_view bytes, const std::string& ending, const std::string& name);

// Steps 2 to 4.
void mergeNodes(SurfaceFromFile& surface);
void orient(SurfaceFromFile& surface);

}  // namespace corpuscle::geometry
