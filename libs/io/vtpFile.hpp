// VTK's XML PolyData as it stands in a file (.vtp): pieces with points, four kinds of cells, and arrays.
//
// Files are read by our own code, since VTK's reader trusts what a file says about itself: with it a wrong index or
// length ends in a memory error. Here every length is compared with the bytes that are present before memory is
// allocated, the corners of every cell must be points of the piece, and every array must have as many tuples as there
// are points or cells.
//
// Formats that are read: ascii, binary (base64) and appended (raw or base64), either byte order, headers of 32 and 64
// bits, uncompressed or by vtkZLibDataCompressor, vtkLZ4DataCompressor or vtkLZMADataCompressor. Of arrays with several
// time steps the first is read.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/vec.hpp"

namespace corpuscle::io {

struct VtpArray {
    enum class Kind { real, integer, text };
    std::string name;
    Kind kind = Kind::real;
    int components = 1;
    std::vector<double> reals;           // tuples x components; Kind::real
    std::vector<std::int64_t> integers;  // the same; Kind::integer
    std::vector<std::string> texts;
};

// Corners of cell i: corners[i > 0 ? ends[i - 1] : 0 .. ends[i]).
struct VtpCells {
    std::vector<std::int64_t> corners, ends;
    std::size_t count() const { return ends.size(); }
    std::vector<int> cell(std::size_t i) const {
        return {corners.begin() + (i > 0 ? ends[i - 1] : 0), corners.begin() + ends[i]};
    }
};

struct VtpPiece {
    std::vector<Vec3> points;
    VtpCells vertices, lines, strips, polygons;
    std::vector<VtpArray> point, cell;
    std::size_t cellCount() const { return vertices.count() + lines.count() + strips.count() + polygons.count(); }
};

struct VtpFile {
    std::vector<VtpPiece> pieces;
    std::vector<VtpArray> field;
};

// Throws Failure(ExitCode::io) with `name` and what is wrong.
VtpFile parseVtp(std::string_view bytes, const std::string& name);
VtpFile readVtpFile(const std::filesystem::path& path);

// The bytes of a VTK XML file. Throws Failure(ExitCode::io) when it is missing, cannot be read or lacks its closing
// tag.
std::string readWholeVtkFile(const std::filesystem::path& path);

}  // namespace corpuscle::io
