#include "geometry/enclosedVolume.hpp"

#include <fmt/core.h>

#include <cmath>

#include "core/error.hpp"
#include "geometry/mesher.hpp"

namespace corpuscle::geometry {

namespace {

constexpr double exactEnough = 1e-13, least = 0.5, most = 2.0;  // relative error of the volume; range of c
constexpr int tries = 20;

// Displacement of each node, for c = 1.
std::vector<Vec3> movesOf(const TriangleMesh& mesh, const Shape& shape) {
    std::vector<Vec3> normal(mesh.nodes.size(), Vec3::Zero());
    std::vector<double> gap(mesh.nodes.size(), 0.0), area(mesh.nodes.size(), 0.0);
    for (const Index3& t : mesh.triangles) {
        const Vec3 &p = mesh.nodes[t[0]], &q = mesh.nodes[t[1]], &r = mesh.nodes[t[2]];
        const Vec3 twice = (q - p).cross(r - p), centre = (p + q + r) / 3;
        for (const int m : t) {
            normal[m] += twice;
            gap[m] += 0.75 * (shape.project(centre) - centre).dot(twice);
            area[m] += twice.norm();
        }
    }
    for (std::size_t m = 0; m < normal.size(); ++m) normal[m] = gap[m] / area[m] * normal[m].stableNormalized();
    return normal;
}

}  // namespace

void encloseVolume(TriangleMesh& mesh, const Shape& shape) {
    const double wanted = shape.volume();
    const std::vector<Vec3> from = mesh.nodes, move = movesOf(mesh, shape);
    const auto error = [&](double c) {
        for (std::size_t m = 0; m < from.size(); ++m) mesh.nodes[m] = from[m] + c * move[m];
        return mesh.volume() / wanted - 1;
    };
    // Secant method; the volume is a cubic polynomial of c that is nearly linear.
    double before = 0, c = 1, errorBefore = error(before);
    if (std::abs(errorBefore) < exactEnough) return;
    for (int k = 0; k < tries; ++k) {
        const double here = error(c);
        if (std::abs(here) < exactEnough) break;
        const double next = c - here * (c - before) / (here - errorBefore);
        before = c, errorBefore = here;
        if (!(next >= least && next <= most)) break;  // NaN if c no longer changes
        c = next;
    }
    if (!(std::abs(error(c)) < 1e-10))
        throw Failure(ExitCode::invalidCase,
                      fmt::format("the mesh is too coarse to enclose the volume of its shape: it lacks {:.2g} % of it, "
                                  "and no move of its nodes by half to twice the distance of its facets from the "
                                  "surface makes up for that; take a smaller edge, or `enclose: surface`",
                                  -100 * error(0)));
}

TriangleMesh meshEnclosing(const Shape& shape, double edge, bool exactly) {
    TriangleMesh mesh = meshSurface(shape, edge);
    if (exactly) encloseVolume(mesh, shape);
    return mesh;
}

}  // namespace corpuscle::geometry
