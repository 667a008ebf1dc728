// Moves the nodes of a mesh off the surface that they lie on, so that the mesh encloses the volume of the shape.
//
// Between nodes on a curved surface, facets cut it short: a red cell meshed with edges of an eighth of its radius lacks
// 1.6 % of its volume. Each node moves along the mesh's normal there (mean of its facets' normals by area) by c times
// the mean by area, over its facets, of
//     3/4 g,   g: how far the surface lies outside the facet's centre, along the facet's normal [m]
// which is the mean distance over a facet from a surface that is quadratic above it: there the distance is a sum of
// products of two barycentric coordinates, whose mean is 1/12 and whose value at the centre is 1/9. c makes the volume
// exact; it is 1 but for terms of second order in the edge. Facets then cross the surface, and the error of the area is
// smaller, of second order as before.
#pragma once
#include "geometry/shape.hpp"
#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

// Nodes of a closed mesh, outward oriented, on the surface of the shape. Throws Failure(invalidCase) for a mesh that is
// too coarse for it.
void encloseVolume(TriangleMesh& mesh, const Shape& shape);

// The surface meshed (meshSurface of mesher.hpp), and its volume enclosed where `exactly`.
TriangleMesh meshEnclosing(const Shape& shape, double edge, bool exactly);

}  // namespace corpuscle::geometry
