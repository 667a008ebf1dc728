// Flat sheets in the plane z = 0 about the origin, normals along z: open meshes with a border, for membraneRelax.
//
// rectangle: rows of nodes at a distance of about sqrt(3)/2 edges, every other row shifted by half an edge, so that all
// triangles but those
//            at the two ends are equilateral to the rounding of sides to whole numbers of edges
// disc:      a centre and n rings, ring k of 6 k nodes; edges between 1 and 1.05 of the radius over n
// disorder:  the nodes inside move by up to this many edges along each axis, at random
#pragma once
#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

// Both throw Failure(invalidCase) for an edge that is more than half of the least side or of the radius.
TriangleMesh rectangle(double sizeX, double sizeY, double edge);
TriangleMesh disc(double radius, double edge);

// Moves the nodes that lie on no border; the same seed gives the same mesh.
void disorder(TriangleMesh& sheet, double amplitude, unsigned long seed);

}  // namespace corpuscle::geometry
