#include "geometry/sidesByRays.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"

namespace corpuscle::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

Surface surfaceOf(const TriangleMesh& mesh, const Vec3& shift) {
    Surface surface;
    std::vector<Surface::Vertex_index> vertices;
    for (const Vec3& x : mesh.nodes)
        vertices.push_back(surface.add_vertex({x.x() + shift.x(), x.y() + shift.y(), x.z() + shift.z()}));
    for (const Index3& t : mesh.triangles)
        if (surface.add_face(vertices[static_cast<std::size_t>(t[0])], vertices[static_cast<std::size_t>(t[1])],
                             vertices[static_cast<std::size_t>(t[2])]) == Surface::null_face())
            throw Failure(ExitCode::invalidCase, "the mesh is no surface that has an inside: checkMesh has its faults");
    return surface;
}

}  // namespace

std::vector<RaySide> sidesByRays(const std::vector<Vec3>& points, const std::vector<TriangleMesh>& meshes,
                                 const Vec3& low, const Vec3& high, const Periodicity& period) {
    std::vector<RaySide> sides(points.size());
    std::vector<std::size_t> order(points.size());  // by x, to find those between two planes
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return points[i].x() < points[j].x(); });
    const auto firstFrom = [&](double x) {
        return std::partition_point(order.begin(), order.end(), [&](std::size_t i) { return points[i].x() < x; });
    };
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        Vec3 from = meshes[m].nodes.front(), to = from;
        for (const Vec3& x : meshes[m].nodes) from = from.cwiseMin(x), to = to.cwiseMax(x);
        const double slack = 1e-9 * ((to - from).norm() + (high - low).norm());
        double first[3]{}, last[3]{};  // periods by which the surface is moved so that its bounds meet the box
        for (int k = 0; k < 3; ++k)
            if (period.isAlong(k)) {
                first[k] = std::ceil((low[k] - to[k]) / period.lengths()[k]);
                last[k] = std::floor((high[k] - from[k]) / period.lengths()[k]);
            }
        for (double a = 0; a <= last[0] - first[0]; ++a)
            for (double b = 0; b <= last[1] - first[1]; ++b)
                for (double c = 0; c <= last[2] - first[2]; ++c) {
                    const Vec3 periods(first[0] + a, first[1] + b, first[2] + c);
                    const Surface surface = surfaceOf(meshes[m], periods.cwiseProduct(period.lengths()));
                    const CGAL::Side_of_triangle_mesh<Surface, Kernel> side(surface);
                    const Vec3 by = periods.cwiseProduct(period.lengths());
                    const auto end = firstFrom(to.x() + by.x() + slack);
                    for (auto next = firstFrom(from.x() + by.x() - slack); next != end; ++next) {
                        const std::size_t i = *next;
                        const Vec3 x = points[i] - by;  // for the unmoved surface; rounding stays below the slack
                        if (((x - from).array() < -slack).any() || ((x - to).array() > slack).any()) continue;
                        const CGAL::Bounded_side found = side({points[i].x(), points[i].y(), points[i].z()});
                        if (found == CGAL::ON_UNBOUNDED_SIDE) continue;
                        RaySide& of = sides[i];
                        if (found == CGAL::ON_BOUNDARY) {
                            of.onSurface = true;
                            continue;
                        }
                        of.isInSeveral |= of.mesh > 0;
                        of.mesh = static_cast<int>(m) + 1;
                    }
                }
    }
    return sides;
}

}  // namespace corpuscle::geometry
