// Nearest point and signed distance on a moving mesh, for many points within a given reach of it.
//
// A binary tree of bounding boxes over the triangles, at most four to a leaf, built once by splitting at the median of
// the longest extent. A membrane moves but its triangles keep their neighbours, so that a moved mesh only needs new
// boxes (0.1 ms for 5,000 triangles). A query visits nearer boxes first and skips those beyond the best distance so
// far, which is initially the reach. The result is exact. The sign is that of (x - p).n at the nearest point p, with n
// the pseudo-normal there: the normal of a triangle in its interior, the sum of the two triangles' normals on an edge,
// the angle-weighted sum at a node (Baerentzen and Aanaes 2005). It is correct at edges and nodes of any closed
// surface, and away from the border of an open one.
#pragma once
#include <limits>
#include <vector>

#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

struct SurfacePoint {
    int triangle = -1;            // -1: none within reach
    Vec3 weights = Vec3::Zero();  // barycentric, of the triangle's nodes
    Vec3 point = Vec3::Zero();    // m
    double distance = 0;          // m, positive outside
    explicit operator bool() const { return triangle >= 0; }
};

// Nearest point of one triangle to x, as barycentric weights; a weight of exactly 0 marks an edge, two mark a node.
Vec3 nearestWeights(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

class TriangleTree {
  public:
    // An outward oriented mesh of at least one triangle, closed or with borders; reach in metres.
    TriangleTree(const TriangleMesh& mesh, double reach);

    // The nodes have moved; the triangles are the same.
    void update(const std::vector<Vec3>& nodes);

    // x is in the coordinates of the mesh: near a periodic boundary the caller passes the image of the point that is
    // nearest to the mesh. `within` [m]: nothing further away is searched; a known upper bound of the distance saves
    // most of the work.
    SurfacePoint nearest(const Vec3& x, double within = std::numeric_limits<double>::infinity()) const;

    // Whether a point found by `nearest` lies on the border of the mesh, where the surface ends.
    bool isOnBorder(const SurfacePoint& at) const;

    double reach() const { return reach_; }

  private:
    struct Box {
        Vec3 low, high;
        int first = 0, count = 0;  // triangles of a leaf in the order of the tree; count 0: an inner box
        int second = 0;            // inner: the second child; the first is the next box
        double distance2(const Vec3& x) const { return (low - x).cwiseMax(x - high).cwiseMax(0.0).squaredNorm(); }
    };
    void split(int first, int count, const std::vector<Vec3>& centres, std::vector<int>& order);
    void computeNormals();
    void computeBoxes();
    Vec3 pseudoNormal(int triangle, const Vec3& weights) const;

    std::vector<Vec3> nodes_;
    std::vector<Index3> triangles_;  // in the order of the tree
    std::vector<int> number_;        // in the mesh, of each triangle of the tree
    std::vector<int> place_;         // in the tree, of each triangle of the mesh
    double reach_;

    std::vector<Index3> sideEdge_;  // edge number of each side of each triangle
    std::vector<MeshEdge> edges_;
    std::vector<char> isBorderNode_;  // empty without borders
    std::vector<Vec3> faceNormal_, edgeNormal_, nodeNormal_;
    std::vector<Box> boxes_;  // parents before children
};

}  // namespace corpuscle::geometry
