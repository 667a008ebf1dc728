// Triangulated surface from a file: STL, OFF, PLY or VTP, by the file's ending. Coordinates are kept as written.
//
// 1. Polygons are cut into triangles.
// 2. Nodes at the same place are merged (STL repeats them for each triangle). If the surface is still not closed, nodes
//    nearer to each other than 1e-6 of its size are merged too: some programs round each copy differently.
// 3. Triangles with two equal corners, and nodes that belong to no triangle, are left out.
// 4. Triangles are turned to the orientation of their neighbours, and the whole surface outwards.
// `remarks` lists what was done in steps 2 to 4. Throws Failure with the file, the place and the error: invalidCase for
// its content, io for a file that is missing or cannot be read.
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
