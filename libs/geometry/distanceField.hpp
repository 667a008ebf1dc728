// Signed distance from a closed surface on a grid, for many queries to one rigid mesh; negative inside.
//
// Nodes within `reach` of the surface have their exact distance (triangleTree.hpp), the others +-reach; between nodes,
// the values of the eight nodes around a point are interpolated linearly. Error: at most spacing^2/4 (k1 + k2), k1 and
// k2 the curvatures of the surface.
#pragma once
#include <cmath>
#include <vector>

#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

class DistanceField {
  public:
    // A closed, outward oriented mesh; grid spacing and reach in metres.
    DistanceField(const TriangleMesh& mesh, double spacing, double reach);

    // Signed distance at x, in the mesh's frame; limited to +-reach [m].
    double at(const Vec3& x) const;
    // Bound on the difference between the exact distance and `at` where this is less than the reach [m]: the nodes of
    // the interpolation are at most the diagonal of a grid cell away, and a distance has a gradient of at most 1.
    double margin() const { return std::sqrt(3.0) * spacing_; }

  private:
    Vec3 low_;
    double spacing_, reach_;
    Index3 count_{};             // nodes along each axis
    std::vector<float> values_;  // distance over reach
};

}  // namespace corpuscle::geometry
