// A triangulated surface as a wall: that of a vessel, open where it meets its periodic images, or of obstacles.
//
// Distances are exact within `band` of the surface (geometry/triangleTree, with the images of the surface around the
// box); further away they are interpolated linearly on a grid of spacing s, whose nodes are evaluated when first asked
// for. Error there: at most s^2/4 (k1 + k2), k1 and k2 the curvatures of surfaces of equal distance; at places that are
// as near to one part of the surface as to another, s.
#pragma once
#include <vector>

#include "boundary/surface.hpp"
#include "geometry/triangleTree.hpp"
#include "particles/box.hpp"

namespace corpuscle::boundary {

enum class FluidSide { inside, outside };

class TriangleSurface : public Surface {
  public:
    // mesh: in the coordinates of the box, its normals out of the solid or vessel that it encloses.
    TriangleSurface(const geometry::TriangleMesh& mesh, FluidSide side, const particles::Box& fluid);
    double distance(const Vec3& x) const override;
    Vec3 normal(const Vec3& x) const override;
    double area() const override { return area_; }

  private:
    double exact(const Vec3& x, double within) const;
    double node(const Index3& at) const;
    Vec3 intoBox(Vec3 x) const;

    particles::Box box_;
    double sign_;  // of distances of the tree
    double area_;
    geometry::TriangleTree tree_;
    Vec3 low_ = Vec3::Zero();
    Index3 count_{};  // of nodes
    double spacing_ = 0, band_ = 0;
    mutable std::vector<float> values_;  // distance [m]; not a number: not evaluated yet
};

// Cross-section of a mesh at x, and its perimeter. The mesh may be open at the ends along x.
struct Section {
    double area, perimeter;
};
Section sectionAt(const geometry::TriangleMesh& mesh, double x);

// Volume that a mesh encloses which is closed but for plane ends normal to x.
double volumeWithin(const geometry::TriangleMesh& mesh);
// Integral of the mean curvature over the mesh, above 0 where it is convex outwards [m].
double meanCurvature(const geometry::TriangleMesh& mesh);

}  // namespace corpuscle::boundary
