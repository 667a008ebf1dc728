#include "geometry/readSurface.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <fstream>

#include "core/error.hpp"
#include "geometry/surfaceFile.hpp"

namespace corpuscle::geometry {
namespace {

constexpr std::size_t mostTriangles = 20'000'000;
constexpr std::size_t mostCorners = 1000;  // of a polygon that is not a triangle
constexpr double largestCoordinate = 1e30, leastSize = 1e-30;

struct Format {
    const char* ending;
    PolygonSoup (*read)(std::string_view bytes);
};
constexpr Format formats[] = {{".stl", readStl}, {".off", readOff}, {".ply", readPly}, {".vtp", readVtpSurface}};

// The format that the first bytes indicate, for a file with the wrong ending.
const char* formatOf(std::string_view bytes) {
    if (bytes.starts_with("ply")) return ".ply";
    if (bytes.substr(0, 6).find("OFF") != std::string_view::npos) return ".off";
    if (bytes.substr(0, 200).find("<VTKFile") != std::string_view::npos) return ".vtp";
    if (bytes.starts_with("solid")) return ".stl";
    return nullptr;
}

// Ear clipping in the plane of the polygon: exact for plane polygons, convex or not.
void cutPolygon(const std::vector<Vec3>& points, std::vector<int> corners, std::vector<Index3>& triangles) {
    Vec3 normal = Vec3::Zero();
    for (std::size_t k = 0; k < corners.size(); ++k)
        normal += (points[corners[k]] - points[corners[0]])
                      .cross(points[corners[(k + 1) % corners.size()]] - points[corners[0]]);
    const auto turn = [&](int a, int b, int c) {
        return (points[b] - points[a]).cross(points[c] - points[a]).dot(normal);
    };
    while (corners.size() > 3) {
        const std::size_t n = corners.size();
        std::size_t ear = 0;
        for (; ear < n; ++ear) {
            const int a = corners[(ear + n - 1) % n], b = corners[ear], c = corners[(ear + 1) % n];
            const bool empty = std::none_of(corners.begin(), corners.end(), [&](int p) {
                return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
            });
            if (empty && turn(a, b, c) > 0) break;
        }
        ear %= n;  // no ear: the polygon intersects itself, which the checks of the surface report
        triangles.push_back({corners[(ear + n - 1) % n], corners[ear], corners[(ear + 1) % n]});
        corners.erase(corners.begin() + static_cast<long>(ear));
    }
    triangles.push_back({corners[0], corners[1], corners[2]});
}

TriangleMesh cutPolygons(PolygonSoup& soup) {
    TriangleMesh mesh;
    std::size_t triangles = 0;
    for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
        const std::size_t corners = soup.polygons[p].size();
        if (corners > mostCorners)
            throw SurfaceFault(
                fmt::format("polygon {} has {} corners, at most {} are read; cut it into triangles first", p, corners,
                            mostCorners));
        triangles += corners - 2;
    }
    if (triangles == 0) throw SurfaceFault("no triangles could be read from it: it has points only, or nothing");
    if (triangles > mostTriangles)
        throw SurfaceFault(
            fmt::format("{} triangles, at most {} are read; make the surface coarser, it is remeshed in "
                        "any case",
                        triangles, mostTriangles));
    mesh.triangles.reserve(triangles);
    for (std::vector<int>& corners : soup.polygons)
        if (corners.size() == 3)
            mesh.triangles.push_back({corners[0], corners[1], corners[2]});
        else
            cutPolygon(soup.points, std::move(corners), mesh.triangles);
    mesh.nodes = std::move(soup.points);
    return mesh;
}

double sizeOf(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const Index3& t : mesh.triangles)
        for (const int n : t) {
            const Vec3& x = mesh.nodes[static_cast<std::size_t>(n)];
            if (!(x.cwiseAbs().maxCoeff() <= largestCoordinate))
                throw SurfaceFault(
                    fmt::format("point {} at ({:.6g}, {:.6g}, {:.6g}) cannot be meant: coordinates reach "
                                "{:g} at most",
                                n, x.x(), x.y(), x.z(), largestCoordinate));
            box.extend(x);
        }
    const double size = box.sizes().maxCoeff();
    if (!(size > leastSize)) throw SurfaceFault("all its points lie in one place");
    return size;
}

std::string readBytes(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        throw Failure(ExitCode::io,
                      fmt::format("{}: there is no such file (paths are relative to the case)", file.string()));
    std::ifstream stream(file, std::ios::binary);
    std::string bytes(stream ? std::filesystem::file_size(file, error) : 0, '\0');
    if (!stream || error || !stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
        throw Failure(ExitCode::io, fmt::format("{}: the file cannot be read; check its permissions", file.string()));
    return bytes;
}

}  // namespace

SurfaceFromFile parseSurface(std::string_view bytes, const std::string& ending, const std::string& name) {
    const auto* format =
        std::find_if(std::begin(formats), std::end(formats), [&](const Format& f) { return ending == f.ending; });
    if (format == std::end(formats))
        throw Failure(ExitCode::invalidCase,
                      fmt::format("{}: a surface is read from .stl, .off, .ply or .vtp, not from '{}'", name, ending));
    SurfaceFromFile surface;
    try {
        if (bytes.empty()) throw SurfaceFault("the file is empty");
        PolygonSoup soup = format->read(bytes);
        surface.mesh = cutPolygons(soup);
        surface.size = sizeOf(surface.mesh);
        mergeNodes(surface);
        orient(surface);
    } catch (const SurfaceFault& fault) {
        const char* other = formatOf(bytes);
        throw Failure(ExitCode::invalidCase,
                      fmt::format("{}: {}{}", name, fault.what(),
                                  other && ending != other
                                      ? fmt::format(". Its first bytes are those of a {} file: rename it", other)
                                      : ""));
    }
    return surface;
}

SurfaceFromFile readSurface(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    for (char& c : ending)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (std::none_of(std::begin(formats), std::end(formats), [&](const Format& f) { return ending == f.ending; }))
        return parseSurface("", ending, file.string());
    return parseSurface(readBytes(file), ending, file.string());
}

}  // namespace corpuscle::geometry
