// Curvature of a surface of triangles.
#pragma once
#include "membrane/surface.hpp"

namespace corpuscle::membrane {

// Derivative of the area with respect to the node positions.
inline std::vector<Vec3> areaGradient(std::span<const Vec3> x, std::span<const Index3> triangles) {
    std::vector<Vec3> sum(x.size(), Vec3::Zero());
    for (const Index3& t : triangles) {
        const Vec3 half = 0.5 * areaVector(x, t).stableNormalized();
        for (int k = 0; k < 3; ++k) {
            sum[t[k]] += half.cross(x[t[(k + 2) % 3]] - x[t[(k + 1) % 3]]);
        }
    }
    return sum;
}

// Sum of the principal curvatures at the nodes of a closed surface with outward normals [1/m], 2/R on a sphere: the
// area of a surface that moves by u along its normal grows by the fraction (k1 + k2) u. 0 at a node without area.
inline std::vector<double> curvatures(std::span<const Vec3> x, std::span<const Index3> triangles) {
    const std::vector<Vec3> ofArea = areaGradient(x, triangles), ofVolume = volumeGradient(x, triangles);
    std::vector<double> sum(x.size(), 0.0);
    for (std::size_t m = 0; m < x.size(); ++m) {
        if (const double square = ofVolume[m].squaredNorm(); square > 0) {
            sum[m] = ofArea[m].dot(ofVolume[m]) / square;
        }
    }
    return sum;
}

}  // namespace corpuscle::membrane
