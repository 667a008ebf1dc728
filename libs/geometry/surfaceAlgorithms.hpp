// The algorithms that the mesher combines. Coordinates are of order 1 (the mesher divides by the cell's radius).
#pragma once
#include <functional>

#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

using Projection = std::function<Vec3(const Vec3&)>;

// First mesh of the zero set of F; F is negative at the origin, and each ray from there meets the zero set once (all
// cell shapes here): a subdivided icosahedron stretched to the half sizes `half` of the bounding box and moved along
// the rays. Coarse and stretched, but with the topology of a sphere and the same on every run. (The mesh of CGAL
// make_surface_mesh is not the same on every run: it orders sets by memory addresses.)
TriangleMesh starSurface(const std::function<double(const Vec3&)>& F, const Vec3& half, int refinements);

// Isotropic remeshing by splits, collapses, flips and tangential relaxation (CGAL Polygon_mesh_processing; Botsch and
// Kobbelt 2004); each new or moved node is projected by `project`. Empty if the edge is too coarse to keep two sheets
// of the surface apart.
TriangleMesh remeshIsotropic(const TriangleMesh& mesh, double edge, int iterations, const Projection& project);

// Splits each triangle into four; the new nodes are projected edge midpoints.
TriangleMesh refineOnce(const TriangleMesh& mesh, const Projection& project);

// Flips edges so that the nodes come closer to six edges each, then smooths in rounds: each node moves towards the mean
// of its neighbours and is projected; later rounds also flip edges towards a Delaunay triangulation. Keeps the numbers
// of nodes and triangles.
void smooth(TriangleMesh& mesh, int rounds, const Projection& project);

// selfIntersections stops at this number of pairs: in a crumpled surface it grows with the square of the number of
// triangles.
constexpr std::size_t mostSelfIntersections = 10000;

// Smallest corner angle, degrees.
double smallestAngle(const TriangleMesh& mesh);
double meanEdge(const TriangleMesh& mesh);

}  // namespace corpuscle::geometry
