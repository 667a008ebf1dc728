#include "geometry/fileShape.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "geometry/readSurface.hpp"

namespace corpuscle::geometry {

CORPUSCLE_REGISTER(Shape, FileShape, "file", "closed surface from an STL, OFF, PLY or VTP file");

const Schema<FileShape>& FileShape::schema() {
    static const Schema<FileShape> s =
        Schema<FileShape>("file", "closed surface from a file")
            .text("file", &FileShape::file, "STL, OFF, PLY or VTP file, relative to the case")
            .quantity("scale", &FileShape::scale, unit::metre, "length of one unit of the file",
                      {.fallback = "1 um", .range = positive});
    return s;
}

void FileShape::prepare(const std::filesystem::path& caseDirectory) const {
    if (!(scale > 0)) throw Failure(ExitCode::invalidCase, "file: the scale must be greater than 0");
    TriangleMesh mesh = readSurface(caseDirectory / file);
    if (const auto faults = checkClosedManifold(mesh); !faults.empty()) {
        std::string text = fmt::format("{} is not one closed surface:", file);
        for (const std::string& fault : faults) text += "\n  " + fault;
        throw Failure(ExitCode::invalidCase, text);
    }
    mesh.scale(scale);
    mesh.translate(-mesh.centroid());
    surface_ = std::make_shared<Surface>(mesh);
}

const FileShape::Surface& FileShape::surface() const {
    if (!surface_) throw Failure(ExitCode::invalidCase, fmt::format("the surface {} was not read (prepare)", file));
    return *surface_;
}

double FileShape::implicit(const Vec3& x) const {
    const double distance = (x - surface().tree.nearest(x).point).norm();
    return surface().test.inside(x) ? -distance : distance;
}

Vec3 FileShape::gradient(const Vec3& x) const {
    const auto [point, triangle] = surface().tree.nearest(x);
    const double distance = (x - point).norm();
    if (distance > 1e-9 * radius()) return (x - point) / (surface().test.inside(x) ? -distance : distance);
    const TriangleMesh& mesh = surface().mesh;
    const auto& [i, j, k] = mesh.triangles[triangle];
    return (mesh.nodes[j] - mesh.nodes[i]).cross(mesh.nodes[k] - mesh.nodes[i]).normalized();
}

Vec3 FileShape::project(const Vec3& x) const { return surface().tree.nearest(x).point; }

Eigen::AlignedBox3d FileShape::box() const {
    Eigen::AlignedBox3d box;
    for (const Vec3& x : surface().mesh.nodes) box.extend(x);
    return box;
}

double FileShape::radius() const {
    double a = 0;
    for (const Vec3& x : surface().mesh.nodes) a = std::max(a, std::hypot(x.x(), x.y()));
    return a;
}

}  // namespace corpuscle::geometry
