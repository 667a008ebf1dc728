// Tests whether points lie inside a closed surface; made for many points and one surface.
//
// A ray along +z from the point is intersected with the triangles of one column of a plane grid, counting crossings
// outwards as +1 and inwards as -1. If the ray passes within rounding of an edge, or the point lies within rounding of
// the surface, the generalised winding number decides instead (the sum of the solid angles of all triangles over 4 pi).
#pragma once
#include <optional>
#include <vector>

#include "core/periodicity.hpp"
#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

// 1 inside, 0 outside a closed, outward oriented surface; in between on it. Sums over all triangles.
double windingNumber(const TriangleMesh& mesh, const Vec3& x);

class InsideTest {
  public:
    explicit InsideTest(const TriangleMesh& mesh);  // keeps a copy
    bool inside(const Vec3& x) const;
    // In a periodic box: the image of x that is inside, empty if none is; and whether there is one.
    std::optional<Vec3> imageInside(const Vec3& x, const Periodicity& period) const;
    bool inside(const Vec3& x, const Periodicity& period) const { return imageInside(x, period).has_value(); }

  private:
    TriangleMesh mesh_;
    Vec3 low_, high_;
    double size_, tolerance_;
    int columnsX_, columnsY_;
    std::vector<int> start_, triangles_;  // triangles of column n: start_[n] .. start_[n+1]
};

}  // namespace corpuscle::geometry
