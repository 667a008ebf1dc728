// Inside or outside of a closed surface, for any points and in great number.
//
// A ray along +z from the point is cut with the triangles of one column of a plane grid, counting crossings outwards as
// +1 and inwards as -1. A ray that passes within rounding of an edge, or a point within rounding of the surface, is
// decided by the generalised winding number instead (the sum of the solid angles of all triangles over 4 pi).
#pragma once
#include <optional>
#include <vector>

#include "core/periodicity.hpp"
#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

// 1 inside, 0 outside of a closed, outward oriented surface; in between on it. Costs all triangles.
double windingNumber(const TriangleMesh& mesh, const Vec3& x);

class InsideTest {
  public:
    explicit InsideTest(const TriangleMesh& mesh);  // keeps a copy
    bool inside(const Vec3& x) const;
    // In a periodic box: the image of x that is inside, empty: none is; and whether there is one.
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
