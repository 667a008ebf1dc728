#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>

#include "geometry/surfaceAlgorithms.hpp"

namespace corpuscle::geometry {
namespace {
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;

Kernel::Point_3 point(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

// Triangles that share nothing must not meet; those that share a node may meet only there; those that share an edge
// must not be folded onto each other.
bool cut(const TriangleMesh& mesh, const Index3& s, const Index3& t) {
    std::array<int, 3> common{}, ownS{}, ownT{};
    int shared = 0, nS = 0, nT = 0;
    for (int i : s) std::find(t.begin(), t.end(), i) != t.end() ? common[shared++] = i : ownS[nS++] = i;
    for (int j : t)
        if (std::find(s.begin(), s.end(), j) == s.end()) ownT[nT++] = j;
    const auto p = [&](int n) { return point(mesh.nodes[n]); };
    const auto triangle = [&](const Index3& n) { return Kernel::Triangle_3(p(n[0]), p(n[1]), p(n[2])); };
    if (shared == 0) return CGAL::do_intersect(triangle(s), triangle(t));
    if (shared == 1)
        return CGAL::do_intersect(triangle(s), Kernel::Segment_3(p(ownT[0]), p(ownT[1]))) ||
               CGAL::do_intersect(triangle(t), Kernel::Segment_3(p(ownS[0]), p(ownS[1])));
    if (shared == 2)
        return CGAL::coplanar(p(common[0]), p(common[1]), p(ownS[0]), p(ownT[0])) &&
               CGAL::coplanar_orientation(p(common[0]), p(common[1]), p(ownS[0]), p(ownT[0])) == CGAL::POSITIVE;
    return true;
}
}  // namespace

std::vector<std::pair<int, int>> selfIntersections(const TriangleMesh& mesh) {
    std::vector<Box> boxes;
    boxes.reserve(mesh.triangles.size());
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
        const auto& [i, j, k] = mesh.triangles[t];
        const auto p = [&](int n) { return point(mesh.nodes[n]); };
        if (CGAL::collinear(p(i), p(j), p(k))) continue;
        boxes.emplace_back(p(i).bbox() + p(j).bbox() + p(k).bbox(), t);
    }
    std::vector<std::pair<int, int>> pairs;
    struct Enough {};
    try {
        CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
            const int s = std::min(a.info(), b.info()), t = std::max(a.info(), b.info());
            if (!cut(mesh, mesh.triangles[s], mesh.triangles[t])) return;
            pairs.emplace_back(s, t);
            if (pairs.size() == mostSelfIntersections) throw Enough{};
        });
    } catch (const Enough&) {
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace corpuscle::geometry
