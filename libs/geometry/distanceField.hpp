// Signed distance from a closed surface on a grid, for many questions about one rigid mesh.
//
// Nodes within `reach` of the surface have their exact distance (triangleTree.hpp), the others +-reach; in between the
// eight nodes around a point are interpolated linearly. Error: at most spacing^2/4 (k1 + k2), k the curvatures of the
// surface; negative inside.
#pragma once
#include <cmath>
#include <vector>

#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

class DistanceField {
  public:
    // A closed, outward oriented mesh; grid spacing and reach in metres.
    DistanceField(const TriangleMesh& mesh, double spacing, double reach);

    // In the mesh's frame; at most `reach` away from 0.
    double at(const Vec3& x) const;
    // By how much the exact distance may differ from `at` where that is less than the reach [m]: the nodes between
    // which it is found are no further away than a cell's diagonal, and a distance changes no faster than one moves.
    double margin() const { return std::sqrt(3.0) * spacing_; }

  private:
    Vec3 low_;
    double spacing_, reach_;
    Index3 count_{};             // nodes along each axis
    std::vector<float> values_;  // over reach
};

}  // namespace corpuscle::geometry
