// How far a particle counts from a curved surface when the velocity is continued beyond it.
//
// The flow relative to the surface goes as w ~ s near a plane; near a curved surface the same momentum flux spreads
// over more or less area, and with kappa = k1 + k2, positive for a convex body,
//     w ~ s (1 - kappa s/2)          s: distance from the surface, kappa at s, so that it is exact for a turning
//                                    sphere, s a/(a + s)
// and beyond it, at depth z with kappa there, w ~ -z (1 + kappa z/2). kappa is the Laplacian of the distance. Continued
// linearly, the torque on a sphere is low by about 0.23 (H_s/a)^2. The factors are held between a half and two: at
// sharp edges they mean little.
#pragma once
#include <algorithm>

#include "geometry/distanceField.hpp"

namespace corpuscle::bodies {

// Of the surface of equal distance through x, by second differences [1/m].
inline double curvature(const geometry::DistanceField& distance, const Vec3& x, double step) {
    double sum = -6 * distance.at(x);
    for (int k = 0; k < 3; ++k)
        for (const double way : {-step, step}) sum += distance.at(x + way * Vec3::Unit(k));
    return sum / (step * step);
}

// s (1 - kappa s/2) at x, s its signed distance; positive outside.
inline double effectiveDistance(const geometry::DistanceField& distance, const Vec3& x, double s, double step) {
    return s * std::clamp(1 - 0.5 * curvature(distance, x, step) * s, 0.5, 2.0);
}

}  // namespace corpuscle::bodies
