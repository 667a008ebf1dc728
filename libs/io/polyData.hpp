// Points, their triangles or lines and the arrays of both as one plain value, and its file: VTK's .vtp.
//
// A fluid is points alone; a membrane is points and triangles; rims of holes are points and lines. Everything SI. A
// file written here holds appended raw data, compressed with lz4, with 64-bit headers; doubles keep all their bits.
// Points alone get one vertex cell each, so that ParaView shows them. Files are written under a temporary name and
// renamed (io/publish.hpp). A file with texts (those of 0/) also gets the text "checksum" (io/dataChecksum.hpp), which
// is verified wherever it is read.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/vec.hpp"

namespace corpuscle::io {

// Arrays of the points or of the cells (triangles or lines), by name; each as long as there are of them.
struct Arrays {
    std::map<std::string, std::vector<double>> scalars;
    std::map<std::string, std::vector<Vec3>> vectors;
    std::map<std::string, std::vector<std::int64_t>> integers;

    // For messages, set by readVtp: "0/fluid.vtp: point array", and arrays of other shapes, "has 9 components".
    std::string where;
    std::map<std::string, std::string> others;

    // The array of that name. Throws Failure(ExitCode::io) naming the file, what is there and the nearest name when it
    // is missing or of another type.
    const std::vector<double>& scalar(const std::string& name) const;
    const std::vector<Vec3>& vector(const std::string& name) const;
    const std::vector<std::int64_t>& integer(const std::string& name) const;

    bool empty() const { return scalars.empty() && vectors.empty() && integers.empty(); }
    std::vector<std::string> names() const;  // sorted
};

struct PolyData {
    std::vector<Vec3> points;             // [m]
    std::vector<Index3> triangles;        // indices into points
    std::vector<std::vector<int>> lines;  // the same, along each line; triangles or lines, not both
    Arrays point, cell;
    std::map<std::string, double> field;       // one number each: TimeValue [s], strain
    std::map<std::string, std::string> texts;  // field data too, one text each
    bool verified = false;                     // by readVtp: the file has a checksum, which is right
};

// Puts a piece with the same arrays behind what there is; field data and texts stay.
void append(PolyData& all, const PolyData& piece);

enum class Cells { vertices, triangles, lines };

// Throws Failure(ExitCode::io) when the file cannot be written, std::invalid_argument when an array has the wrong
// length, a triangle or line names a point that does not exist, or there are both. The second form says which cells to
// write (a rank without triangles or lines in a stream that has some writes none) and adds numbers to the field data.
void writeVtp(const std::filesystem::path& path, const PolyData& data);
void writeVtp(const std::filesystem::path& path, const PolyData& data, Cells cells,
              const std::map<std::string, double>& field);

// Throws Failure(ExitCode::io) when the file is missing, truncated, no PolyData, does not agree with its checksum, has
// cells other than vertices, triangles and lines, or both of these. Numbers of any width are read: floating point with
// 1 or 3 components as scalars or vectors, integers with 1 as integers.
PolyData readVtp(const std::filesystem::path& path);

// All pieces of a .pvtp joined in their order. Throws as readVtp.
PolyData readPvtp(const std::filesystem::path& path);

}  // namespace corpuscle::io
