// Flat sheets in the plane z = 0 about the origin, normals along z: open meshes with a border, for membraneRelax.
//
// rectangle: rows of nodes about sqrt(3)/2 edges apart, every other row shifted by half an edge. All triangles but
//            those at the two ends are equilateral, up to the rounding of sides to whole numbers of edges
// disc:      a centre and n rings, ring k with 6 k nodes; edges between 1 and 1.05 times the radius over n
// disorder:  the inner nodes move at random along each axis, by up to `amplitude` edges
#pragma once
#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

// Both throw Failure(invalidCase) for an edge longer than half of the shorter side, or of the radius.
TriangleMesh rectangle(double sizeX, double sizeY, double edge);
TriangleMesh disc(double radius, double edge);

// Moves the nodes that are not on the border; the same seed gives the same mesh.
void disorder(TriangleMesh& sheet, double amplitude, unsigned long seed);

}  // namespace corpuscle::geometry
