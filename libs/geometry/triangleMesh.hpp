// Closed triangulated surface, outward oriented (nodes of a triangle counter-clockwise seen from outside). In metres.
//
// Integrals over the enclosed solid come from the divergence theorem, one tetrahedron (origin, a, b, c) per triangle
// with D = a.(b x c) and s = a+b+c:
//     V = sum D/6        centroid = sum D s/24 / V        int x x^T dV = sum D/120 [s s^T + a a^T + b b^T + c c^T]
// They are exact for the polyhedron. The vertex area is a third of the area of the triangles around a node, so that the
// sum over the nodes is the area of the mesh.
#pragma once
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/vec.hpp"

namespace corpuscle::geometry {

// An edge and its two triangles. `left` runs through a -> b, `right` through b -> a; -1 where there is none.
struct MeshEdge {
    int a, b;  // a < b
    int left, right;
};

struct TriangleMesh {
    std::vector<Vec3> nodes;
    std::vector<Index3> triangles;

    double area() const;
    double volume() const;                // signed: negative when the triangles point inwards
    Vec3 centroid() const;                // of the enclosed solid
    Mat3 inertia() const;                 // of the enclosed solid at density 1 about its centroid, m^5
    std::vector<MeshEdge> edges() const;  // sorted by (a, b); valid for closed manifolds
    std::vector<double> vertexAreas() const;
    std::vector<Vec3> vertexNormals() const;  // unit, weighted by the angle of each triangle at the node

    void translate(const Vec3& by);
    void rotate(const Mat3& rotation, const Vec3& about = Vec3::Zero());
    void scale(double factor);
    void flip();  // reverses the orientation
};

// Angle of the triangle at its node 0, 1 or 2, in radians.
double cornerAngle(const Vec3& at, const Vec3& next, const Vec3& previous);

// Rotation that takes the z axis to `axis` (any length above zero) the shortest way.
Mat3 rotationFromZ(const Vec3& axis);

// A message for every way in which the mesh is not one closed, outward oriented, non-degenerate surface without
// self-intersections; empty if it is one. `unit` is appended to the coordinates in messages. Triangles that intersect
// each other are searched for only in a surface without other faults.
std::vector<std::string> checkClosedManifold(const TriangleMesh& mesh, const std::string& unit = " m");

// Pairs of triangles that intersect each other (exact predicates).
std::vector<std::pair<int, int>> selfIntersections(const TriangleMesh& mesh);

}  // namespace corpuscle::geometry
