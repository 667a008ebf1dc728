#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "io/dataChecksum.hpp"
#include "io/polyData.hpp"
#include "io/vtpFile.hpp"
#include "io/xml.hpp"

namespace corpuscle::io {
namespace {

void addArray(VtpArray& array, Arrays& arrays) {
    const std::string& name = array.name;
    const bool real = array.kind == VtpArray::Kind::real;
    if (name.empty() || array.kind == VtpArray::Kind::text) return;
    if (real && array.components == 1) {
        arrays.scalars[name] = std::move(array.reals);
    } else if (real && array.components == 3) {
        auto& vectors = arrays.vectors[name];
        vectors.resize(array.reals.size() / 3);
        for (std::size_t i = 0; i < vectors.size(); ++i)
            vectors[i] = {array.reals[3 * i], array.reals[3 * i + 1], array.reals[3 * i + 2]};
    } else if (!real && array.components == 1) {
        arrays.integers[name] = std::move(array.integers);
    } else {
        arrays.others[name] = fmt::format("has {} {} each", array.components, real ? "components" : "integers");
    }
}

void append(Arrays& all, const Arrays& piece, const std::string& where) {
    auto join = [](auto& target, const auto& source) {
        for (const auto& [name, values] : source) target[name].insert(target[name].end(), values.begin(), values.end());
    };
    join(all.scalars, piece.scalars);
    join(all.vectors, piece.vectors);
    join(all.integers, piece.integers);
    all.others.insert(piece.others.begin(), piece.others.end());
    all.where = where;
}

// Converts one piece; fail(text) makes the exception to throw.
template <class F>
PolyData toPolyData(VtpPiece& piece, const std::string& where, F&& fail) {
    PolyData data;
    data.points = std::move(piece.points);
    if (piece.strips.count() > 0) throw fail("only points, triangles and lines are read, the file has strips.");
    if (piece.lines.count() > 0 && piece.polygons.count() > 0)
        throw fail("triangles or lines are read, the file has both.");
    for (std::size_t i = 0; i < piece.lines.count(); ++i) data.lines.push_back(piece.lines.cell(i));
    for (std::size_t i = 0; i < piece.polygons.count(); ++i) {
        const std::vector<int> corners = piece.polygons.cell(i);
        if (corners.size() != 3)
            throw fail(fmt::format("cell {} has {} corners; only triangles are read.", i, corners.size()));
        data.triangles.push_back({corners[0], corners[1], corners[2]});
    }
    if (piece.vertices.count() > 0 && !piece.cell.empty())
        throw fail("arrays on vertex cells are not read; put them on the points.");
    data.point.where = where + ": point array";
    data.cell.where = where + ": cell array";
    for (VtpArray& array : piece.point) addArray(array, data.point);
    for (VtpArray& array : piece.cell) addArray(array, data.cell);
    return data;
}

}  // namespace

void append(PolyData& all, const PolyData& piece) {
    const int first = static_cast<int>(all.points.size());
    all.points.insert(all.points.end(), piece.points.begin(), piece.points.end());
    for (const auto& t : piece.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    for (std::vector<int> line : piece.lines) {
        for (int& corner : line) corner += first;
        all.lines.push_back(std::move(line));
    }
    append(all.point, piece.point, all.point.where);
    append(all.cell, piece.cell, all.cell.where);
}

PolyData readVtp(const std::filesystem::path& path) {
    const auto fail = [&](const std::string& what) -> Failure {
        return {ExitCode::io, fmt::format("{}: {}", path.string(), what)};
    };
    VtpFile file = readVtpFile(path);
    PolyData data = toPolyData(file.pieces.front(), path.string(), fail);
    for (std::size_t i = 1; i < file.pieces.size(); ++i) append(data, toPolyData(file.pieces[i], path.string(), fail));
    for (const VtpArray& array : file.field) {
        if (array.reals.size() == 1) data.field[array.name] = array.reals.front();
        if (array.integers.size() == 1) data.field[array.name] = static_cast<double>(array.integers.front());
        if (array.texts.size() == 1) data.texts[array.name] = array.texts.front();
    }
    if (const auto noted = data.texts.find(checksumText); noted != data.texts.end()) {
        if (noted->second != dataChecksum(data))
            throw fail(
                "the file is damaged, or was changed by another program: its data do not agree with its checksum.");
        data.texts.erase(noted);
        data.verified = true;
    }
    return data;
}

PolyData readPvtp(const std::filesystem::path& path) {
    const std::string bytes = readWholeVtkFile(path);
    XmlElement root;
    try {
        root = parseXml(bytes);
    } catch (const XmlFault& fault) {
        throw Failure(ExitCode::io,
                      fmt::format("{}: the file is corrupt or no VTK XML file: {}.", path.string(), fault.what()));
    }
    const XmlElement* pieces = root.child("PPolyData");
    if (!pieces)
        throw Failure(ExitCode::io, fmt::format("{}: the file is no VTK XML PPolyData (.pvtp).", path.string()));

    PolyData all;
    all.point.where = path.string() + ": point array";
    all.cell.where = path.string() + ": cell array";
    for (const XmlElement& element : pieces->children) {
        const std::string* source = element.attribute("Source");
        if (element.name != "Piece" || !source) continue;
        const PolyData piece = readVtp(path.parent_path() / *source);
        append(all, piece);
        all.field.insert(piece.field.begin(), piece.field.end());
    }
    return all;
}

}  // namespace corpuscle::io
