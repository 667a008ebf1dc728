// Nearest point of a fixed triangulation at any distance (CGAL AABB tree).
#pragma once
#include <memory>

#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

class SurfaceTree {
  public:
    explicit SurfaceTree(const TriangleMesh& mesh);  // does not keep the mesh
    ~SurfaceTree();
    struct Nearest {
        Vec3 point;
        int triangle;
    };
    Nearest nearest(const Vec3& x) const;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace corpuscle::geometry
