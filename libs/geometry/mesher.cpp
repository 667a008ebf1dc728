#include "geometry/mesher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "geometry/surfaceAlgorithms.hpp"

namespace corpuscle::geometry {
namespace {

constexpr int baseRefinements = 4;  // of the icosahedron: 5,120 triangles

TriangleMesh firstMesh(const Shape& shape, double a) {
    if (const TriangleMesh* own = shape.triangulation()) {
        TriangleMesh mesh = *own;
        mesh.scale(1 / a);
        return mesh;
    }
    return starSurface([&](const Vec3& x) { return shape.implicit(a * x); }, shape.box().max() / a, baseRefinements);
}

// That of an ellipsoid in the shape's box, or of the shape's own triangulation if this is larger.
double estimatedArea(const Shape& shape) {
    const Vec3 sides = shape.box().sizes();
    const double ofBox = 2 * (sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0]) * std::numbers::pi / 6;
    return shape.triangulation() ? std::max(ofBox, shape.triangulation()->area()) : ofBox;
}

bool everyEdgeHasTwoTriangles(const TriangleMesh& mesh) {
    const std::vector<MeshEdge> edges = mesh.edges();
    return 2 * edges.size() == 3 * mesh.triangles.size() &&
           std::all_of(edges.begin(), edges.end(), [](const MeshEdge& e) { return e.left >= 0 && e.right >= 0; });
}

}  // namespace

std::string tooManyTriangles(const Shape& shape, double edge) {
    const double ofEdge = std::numbers::sqrt3 / 4 * edge * edge, triangles = estimatedArea(shape) / ofEdge;
    if (triangles <= mostTriangles) return {};
    // The bound with two digits, rounded up.
    const double least = 1e6 * edge * std::sqrt(triangles / mostTriangles),
                 digit = std::pow(10, std::floor(std::log10(least)) - 1);
    return fmt::format(
        "edge = {:.4g} um would make {:.2g} triangles, at most {:g} are meshed: take an edge of {:.4g} um or "
        "more",
        edge * 1e6, triangles, mostTriangles, std::ceil(least / digit) * digit);
}

TriangleMesh meshSurface(const Shape& shape, double edge, const MesherOptions& options) {
    const double a = shape.radius();
    if (!(edge > 0 && edge <= 0.5 * a))
        throw Failure(
            ExitCode::invalidCase,
            fmt::format(
                "edge = {:.4g} um does not suit a cell of radius {:.4g} um: take more than 0 and at most half the "
                "radius, {:.4g} um",
                edge * 1e6, a * 1e6, a * 0.5e6));
    if (const std::string why = tooManyTriangles(shape, edge); !why.empty()) throw Failure(ExitCode::invalidCase, why);
    const double target = edge / a;
    const Projection project = [&](const Vec3& x) -> Vec3 { return shape.project(a * x) / a; };

    TriangleMesh mesh = firstMesh(shape, a);
    const double halvings = std::ceil(std::log2(std::max(1.0, meanEdge(mesh) / (1.5 * target))));
    if (static_cast<double>(mesh.triangles.size()) * std::exp2(2 * halvings) > 10 * mostTriangles)
        throw Failure(ExitCode::invalidCase,
                      fmt::format("edge = {:.4g} um is too fine for a surface whose {} triangles are so long and thin: "
                                  "they would have to be cut into {:.2g}; take a larger edge, or a surface of rounder "
                                  "triangles",
                                  edge * 1e6, mesh.triangles.size(),
                                  static_cast<double>(mesh.triangles.size()) * std::exp2(2 * halvings)));
    for (Vec3& x : mesh.nodes) x = project(x);
    while (meanEdge(mesh) > 1.5 * target) mesh = refineOnce(mesh, project);

    // Smoothing shortens the edges of a remeshed surface by about 5 %.
    double length = 1.05 * target, angle = 0, mean = 0;
    for (int round = 0; round < options.rounds; ++round) {
        mesh = remeshIsotropic(mesh, length, 3, project);
        if (mesh.triangles.empty() || !everyEdgeHasTwoTriangles(mesh))
            throw Failure(ExitCode::invalidCase,
                          fmt::format("edge = {:.4g} um is too coarse for where the shape is thin or sharply curved: "
                                      "the mesher cannot keep its two sides apart; take a smaller one",
                                      edge * 1e6));
        smooth(mesh, 20, project);
        angle = smallestAngle(mesh);
        mean = meanEdge(mesh);
        if (std::abs(mean / target - 1) > 0.03) {
            length *= target / mean;
        } else if (angle >= options.smallestAngle) {
            mesh.scale(a);
            for (Vec3& x : mesh.nodes) x = shape.project(x);
            return mesh;
        }
    }
    throw Failure(
        ExitCode::numerics,
        fmt::format(
            "the mesher reached a smallest angle of {:.1f} degrees and a mean edge of {:.4g} um instead of {:.1f} "
            "degrees and {:.4g} um: take a smaller edge. If the surface itself has sharp edges or corners, as a cube, "
            "no "
            "edge length helps: round them",
            angle, mean * a * 1e6, options.smallestAngle, edge * 1e6));
}

}  // namespace corpuscle::geometry
