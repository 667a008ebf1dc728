#include "geometry/fileShape.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "geometry/readSurface.hpp"

namespace corpuscle::geometry {

CORPUSCLE_REGISTER(Shape, FileShape, "file", "closed surface from an STL, OFF, PLY or VTP file");

namespace {

constexpr double leastLength = 50e-9, mostLength = 0.01;     // of anything that is taken for a cell [m]
constexpr double likelyLeast = 0.5e-6, likelyMost = 500e-6;  // for advice [m]

// Which of the usual units of length brings `size` nearest to a red cell's and between the limits; empty: none.
std::string otherScale(double size, double least, double most) {
    constexpr double cell = 8e-6;
    double best = 0;
    for (const double one : {1e-9, 1e-6, 1e-3, 1e-2, 1.0})
        if (one * size >= least && one * size <= most &&
            (best == 0 || std::abs(std::log(one * size / cell)) < std::abs(std::log(best * size / cell))))
            best = one;
    if (best == 0) return {};
    return fmt::format("with 'scale: {}' it would be {} long", formatQuantity(best, unit::metre),
                       formatQuantity(best * size, unit::metre));
}

}  // namespace

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
    auto [mesh, size, remarks] = readSurface(caseDirectory / file);
    if (const double length = scale * size; !(length >= leastLength && length <= mostLength)) {
        const std::string cure = otherScale(size, likelyLeast, likelyMost);
        throw Failure(
            ExitCode::invalidCase,
            fmt::format("{}: the surface is {} long with 'scale: {}', the length of one unit of the file, and no "
                        "cell is; {}",
                        file, formatQuantity(length, unit::metre), formatQuantity(scale, unit::metre),
                        cure.empty() ? fmt::format("its box is {:.6g} units long", size) : cure));
    }
    if (const auto faults = checkClosedManifold(mesh, ""); !faults.empty()) {
        std::string text = fmt::format("{} is not one closed surface:", file);
        for (const std::string& fault : faults) text += "\n  " + fault;
        throw Failure(ExitCode::invalidCase, text);
    }
    mesh.scale(scale);
    mesh.translate(-mesh.centroid());
    for (std::string& remark : remarks) remark.insert(0, file + ": ");
    surface_ = std::make_shared<Surface>(mesh, size, std::move(remarks));
}

std::string FileShape::cureForSize(double least, double most) const {
    if (const double length = scale * surface().size; length >= least && length <= most) return {};
    return otherScale(surface().size, least, most);
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
