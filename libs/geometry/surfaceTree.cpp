#include "geometry/surfaceTree.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

namespace corpuscle::geometry {
namespace {
using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
}  // namespace

struct SurfaceTree::Tree {
    Triangles triangles;
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> boxes;
};

SurfaceTree::SurfaceTree(const TriangleMesh& mesh) : tree_(std::make_unique<Tree>()) {
    const auto p = [&](int n) { return Kernel::Point_3(mesh.nodes[n].x(), mesh.nodes[n].y(), mesh.nodes[n].z()); };
    for (const auto& [i, j, k] : mesh.triangles) tree_->triangles.emplace_back(p(i), p(j), p(k));
    tree_->boxes.insert(tree_->triangles.begin(), tree_->triangles.end());
    tree_->boxes.build();
    tree_->boxes.accelerate_distance_queries();
}

SurfaceTree::~SurfaceTree() = default;

SurfaceTree::Nearest SurfaceTree::nearest(const Vec3& x) const {
    const auto [point, triangle] = tree_->boxes.closest_point_and_primitive({x.x(), x.y(), x.z()});
    return {Vec3(point.x(), point.y(), point.z()), static_cast<int>(triangle - tree_->triangles.begin())};
}

}  // namespace corpuscle::geometry
