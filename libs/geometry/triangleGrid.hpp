// Nearest triangle of a moving mesh for many points within a given reach of it, with the sign of the side.
//
// Cubic cells cover the mesh and its reach. A triangle lies in the ball of its centroid c and radius R, so that its distance to a point y
// is between |y - c| - R and |y - c|. Each cell (centre y, half diagonal r) lists the triangles that can be nearest to any of its
// points: |y - c| - R <= min |y - c| + 2 r, and <= reach + r. A query reads the list of one cell twice: for the least |x - c|, then for
// the exact distance to the few triangles that the bound leaves. Exact, not approximate.
// The sign is that of (x - p).n at the nearest point p, n the pseudo-normal there: of the triangle inside it, the sum of two
// triangles' normals on an edge, the angle-weighted sum at a node (Baerentzen and Aanaes 2005); right at edges and nodes of any
// closed surface.
#pragma once
#include <vector>

#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

struct SurfacePoint {
    int triangle = -1;           // -1: none within reach
    Vec3 weights = Vec3::Zero(); // barycentric, of the triangle's nodes
    Vec3 point = Vec3::Zero();   // m
    double distance = 0;         // m, positive outside
    explicit operator bool() const { return triangle >= 0; }
};

// Nearest point of one triangle to x, as barycentric weights; a weight of exactly 0 marks an edge, two mark a node.
Vec3 nearestWeights(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

class TriangleGrid {
  public:
    // A closed, outward oriented mesh; reach in metres.
    TriangleGrid(const TriangleMesh& mesh, double reach);

    // The nodes have moved; the triangles are the same.
    void update(const std::vector<Vec3>& nodes);

    // Coordinates of the mesh: near a periodic boundary the caller passes the image of the point that is nearest to the mesh.
    SurfacePoint nearest(const Vec3& x) const;

    double reach() const { return reach_; }

  private:
    struct Ball {
        Vec3 centre;
        double radius;
    };
    int cellOf(const Vec3& x) const;  // -1 outside
    void placeCells();
    void listCandidates();
    void computeNormalsAndBalls();
    Vec3 pseudoNormal(int triangle, const Vec3& weights) const;

    std::vector<Vec3> nodes_;
    std::vector<Index3> triangles_;
    double reach_;

    std::vector<Index3> sideEdge_;  // edge number of each side of each triangle
    std::vector<MeshEdge> edges_;
    std::vector<Vec3> faceNormal_, edgeNormal_, nodeNormal_;
    std::vector<Ball> balls_;

    Vec3 low_ = Vec3::Zero();
    double size_ = 1;  // of a cell, m
    Index3 count_{1, 1, 1};
    std::vector<int> start_, candidates_;  // triangles of cell n: candidates_[start_[n]] up to start_[n+1]
};

}  // namespace corpuscle::geometry
