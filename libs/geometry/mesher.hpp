// Triangle mesh of a cell shape with edges of one length and nodes on the exact surface.
//
// 1. A subdivided icosahedron moved onto the surface along rays from the centre (or the shape's own triangulation).
// 2. Refined, or coarsened, to the wanted edge length by isotropic remeshing.
// 3. Smoothing with edge flips until the smallest angle exceeds the wanted one; steps 2 and 3 are repeated with a
//    corrected length until the mean edge is within 3 % of the wanted one.
// Every node is put on the exact surface by Newton's method each time it moves, so the nodes carry no discretisation
// error; area and volume of the mesh converge with the square of the edge length. The same input gives the same mesh.
#pragma once
#include <string>

#include "geometry/shape.hpp"
#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

struct MesherOptions {
    double smallestAngle = 31;  // degrees; the mesher fails when it cannot reach it
    int rounds = 12;            // largest number of rounds of remeshing and smoothing
};

// A mesh around the origin with its axis along z. Throws Failure(invalidCase) for an edge length that does not suit the
// shape, and Failure(numerics) if the quality is not reached.
TriangleMesh meshSurface(const Shape& shape, double edge, const MesherOptions& options = {});

// A message that says why this shape is not meshed with this edge length; empty if it can be meshed. The number of
// triangles is predicted from the area; more than `mostTriangles` take minutes and gigabytes.
constexpr double mostTriangles = 2e6;
std::string tooManyTriangles(const Shape& shape, double edge);

struct MeshQuality {
    int nodes = 0, triangles = 0, edges = 0;
    double edgeMin = 0, edgeMean = 0, edgeMax = 0;  // m
    double angleMin = 0, angleMax = 0;              // degrees
    std::vector<int> valence;                       // valence[n]: nodes with n edges
    double area = 0, volume = 0;                    // of the mesh
    double exactArea = 0, exactVolume = 0;          // of the shape; zero when there is none
    double areaError = 0, volumeError = 0;          // relative
    double residual = 0;       // largest distance of a node to the surface, |F|/|grad F|, over the radius
    int euler = 0;             // nodes - edges + triangles: 2 for a sphere's topology
    bool closed = false;       // checkClosedManifold found nothing
    std::string text() const;  // a small table
};

MeshQuality meshQuality(const TriangleMesh& mesh, const Shape* shape = nullptr);

}  // namespace corpuscle::geometry
