// Which points lie inside closed surfaces in a periodic box, by another method than tagSides (latticeFill.hpp), to
// check its results.
//
//                 | tagSides                                          | sidesByRays
// inside          | signed crossings of a ray along z, columns        | parity of crossings of a ray, exact
//                 |                                                   | predicates (CGAL Side_of_triangle_mesh)
// periodic images | the point is moved into the bounds of the surface | the surface is moved into the box, by every
//                 |                                                   | shift for which it reaches into it
// The two functions have no code in common.
#pragma once
#include "core/periodicity.hpp"
#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

struct RaySide {
    int mesh = 0;              // 0: in none; n: in meshes[n - 1], the last one where there are several
    bool onSurface = false;    // exactly on one of the surfaces
    bool isInSeveral = false;  // inside several meshes, or several images of one
};

// low, high: the box, in which the points lie. Throws Failure(invalidCase) for a mesh that is not a closed surface.
std::vector<RaySide> sidesByRays(const std::vector<Vec3>& points, const std::vector<TriangleMesh>& meshes,
                                 const Vec3& low, const Vec3& high, const Periodicity& period);

}  // namespace corpuscle::geometry
