// Points, their triangles or lines, and the arrays on them as one plain value; and its file format, VTK's .vtp.
//
// A fluid is points alone; a membrane is points and triangles; rims of holes are points and lines. Everything is in SI
// units. A file written here holds appended raw data, compressed with lz4, with 64-bit headers; doubles keep all their
// bits. Points alone get one vertex cell each, so that ParaView shows them. Files are written under a temporary name
// and renamed (io/publish.hpp). A file with texts (those of 0/) also gets the text "checksum" (io/dataChecksum.hpp),
// which is verified whenever the file is read.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/vec.hpp"

namespace corpuscle::io {

// Arrays on the points or on the cells (triangles or lines), by name; each has one entry per point or cell.
struct Arrays {
    std::map<std::string, std::vector<double>> scalars;
    std::map<std::string, std::vector<Vec3>> vectors;
    std::map<std::string, std::vector<std::int64_t>> integers;

    // For messages, set by readVtp. where: "0/fluid.vtp: point array"; others: arrays of other shapes, each with a text
    // like "has 9 components".
    std::string where;
    std::map<std::string, std::string> others;

    // The array of that name. Throws Failure(ExitCode::io) naming the file, the existing arrays and the nearest name
    // when it is missing or of another type.
    const std::vector<double>& scalar(const std::string& name) const;
    const std::vector<Vec3>& vector(const std::string& name) const;
    const std::vector<std::int64_t>& integer(const std::string& name) const;

    bool empty() const { return scalars.empty() && vectors.empty() && integers.empty(); }
    std::vector<std::string> names() const;  // sorted
};

struct PolyData {
    std::vector<Vec3> points;             // [m]
    std::vector<Index3> triangles;        // indices into points
    std::vector<std::vector<int>> lines;  // indices of the points along each line; triangles or lines, not both
    Arrays point, cell;
    std::map<std::string, double> field;       // one number each: TimeValue [s], strain
    std::map<std::string, std::string> texts;  // field data too, one text each
    bool verified = false;                     // set by readVtp: the file has a checksum, and it is right
};

// Appends a piece that has the same arrays; field data and texts of `all` stay.
void append(PolyData& all, const PolyData& piece);

enum class Cells { vertices, triangles, lines };

// Throws Failure(ExitCode::io) when the file cannot be written, std::invalid_argument when an array has the wrong
// length, a triangle or line names a point that does not exist, or there are both triangles and lines. The second form
// says which cells to write (in a stream that has triangles or lines, a rank without any writes none) and adds numbers
// to the field data.
void writeVtp(const std::filesystem::path& path, const PolyData& data);
void writeVtp(const std::filesystem::path& path, const PolyData& data, Cells cells,
              const std::map<std::string, double>& field);

// Throws Failure(ExitCode::io) when the file is missing, truncated or not PolyData, does not agree with its checksum,
// has cells other than vertices, triangles and lines, or has both triangles and lines. Numbers of any width are read:
// floating-point arrays with 1 or 3 components as scalars or vectors, integer arrays with 1 component as integers.
PolyData readVtp(const std::filesystem::path& path);

// All pieces of a .pvtp joined in their order. Throws as readVtp.
PolyData readPvtp(const std::filesystem::path& path);

}  // namespace corpuscle::io
