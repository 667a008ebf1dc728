// The algorithms that the mesher puts together. Coordinates of order 1 (the mesher divides by the cell's radius).
#pragma once
#include <functional>

#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

using Projection = std::function<Vec3(const Vec3&)>;

// First mesh of the zero set of F, which is negative at the origin and met once by each ray from there (all cell shapes
// here): a subdivided icosahedron stretched to the half sizes `half` of the bounding box and moved along the rays.
// Coarse and stretched, but a sphere in topology and the same on every run. (CGAL make_surface_mesh is not: it orders
// sets by memory addresses.)
TriangleMesh starSurface(const std::function<double(const Vec3&)>& F, const Vec3& half, int refinements);

// Isotropic remeshing by splits, collapses, flips and tangential relaxation (CGAL Polygon_mesh_processing; Botsch and
// Kobbelt 2004), each new or moved node taken through `project`. Empty where the length is too coarse to keep two
// sheets apart.
TriangleMesh remeshIsotropic(const TriangleMesh& mesh, double edge, int iterations, const Projection& project);

// Each triangle into four; the new nodes are projected edge midpoints.
TriangleMesh refineOnce(const TriangleMesh& mesh, const Projection& project);

// Flips edges towards six edges at each node, then rounds of smoothing, in which a node moves to the mean of its
// neighbours and is projected, the later ones with flips towards Delaunay. Keeps the numbers of nodes and triangles.
void smooth(TriangleMesh& mesh, int rounds, const Projection& project);

// selfIntersections stops at so many: a crumpled surface has as many pairs as it has triangles, squared.
constexpr std::size_t mostSelfIntersections = 10000;

// Smallest corner angle, degrees.
double smallestAngle(const TriangleMesh& mesh);
double meanEdge(const TriangleMesh& mesh);

}  // namespace corpuscle::geometry
