// Which points lie inside closed surfaces in a periodic box, by another method than latticeFill's tagSides: to check
// it.
//
//                | tagSides                                            | this
// inside          | signed crossings of a ray along z, columns          | parity of crossings of a ray, exact
//                                                                       | predicates (CGAL Side_of_triangle_mesh)
// periodic images | the point is moved into the bounds of the surface   | the surface is moved into the box, as often
//                                                                       | as it takes
// They have no code in common.
#pragma once
#include "core/periodicity.hpp"
#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

struct RaySide {
    int mesh = 0;              // 0: in none; n: in meshes[n - 1], the last one where there are several
    bool onSurface = false;    // of one of them, exactly
    bool isInSeveral = false;  // or in several images of one
};

// low, high: the box, in which the points lie. Throws Failure(invalidCase) for a mesh that is no closed surface.
std::vector<RaySide> sidesByRays(const std::vector<Vec3>& points, const std::vector<TriangleMesh>& meshes,
                                 const Vec3& low, const Vec3& high, const Periodicity& period);

}  // namespace corpuscle::geometry
