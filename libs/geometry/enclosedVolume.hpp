// Moves the nodes of a mesh off the surface that they lie on, so that the mesh encloses the volume of the shape.
//
// Flat facets between nodes on a curved surface lose volume: a red cell meshed with edges of an eighth of its radius
// lacks 1.6 % of its volume. Each node moves along the mesh's normal there (area-weighted mean of its facets' normals)
// by c times the area-weighted mean, over its facets, of
//     3/4 g,   g: how far the surface lies outside the facet's centre, along the facet's normal [m]
// This is the mean distance over a facet from a surface that is quadratic above it: the distance is then a sum of
// products of two barycentric coordinates, whose mean is 1/12 and whose value at the centre is 1/9. c makes the volume
// exact; it differs from 1 by terms of second order in the edge. The facets then cross the surface; the error of the
// area is smaller, and still of second order.
#pragma once
#include "geometry/shape.hpp"
#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

// The mesh is closed and outward oriented, with its nodes on the surface of the shape. Throws Failure(invalidCase) if
// it is too coarse.
void encloseVolume(TriangleMesh& mesh, const Shape& shape);

// Meshes the surface (meshSurface of mesher.hpp); if `exactly`, the mesh encloses the volume of the shape.
TriangleMesh meshEnclosing(const Shape& shape, double edge, bool exactly);

}  // namespace corpuscle::geometry
