// Effective distance of a particle from a curved surface, used to continue the velocity beyond the surface.
//
// The velocity w relative to the surface is proportional to the distance s near a plane. Near a curved surface the same
// momentum flux spreads over more or less area, and with kappa = k1 + k2, positive for a convex body,
//     w ~ s (1 - kappa s/2)          kappa at the distance s, so that this is exact for a rotating sphere, s a/(a + s)
// and below the surface, at depth z with kappa there, w ~ -z (1 + kappa z/2). kappa is the Laplacian of the distance.
// With linear continuation the torque on a sphere would be too low by about 0.23 (H_s/a)^2. The factors are limited to
// between a half and two: at sharp edges they mean little.
#pragma once
#include <algorithm>

#include "geometry/distanceField.hpp"

namespace corpuscle::bodies {

// kappa of the surface of equal distance through x, by second differences with this step [m]; in 1/m.
inline double curvature(const geometry::DistanceField& distance, const Vec3& x, double step) {
    double sum = -6 * distance.at(x);
    for (int k = 0; k < 3; ++k)
        for (const double way : {-step, step}) sum += distance.at(x + way * Vec3::Unit(k));
    return sum / (step * step);
}

// s (1 - kappa s/2) at x; s: signed distance of x, positive outside.
inline double effectiveDistance(const geometry::DistanceField& distance, const Vec3& x, double s, double step) {
    return s * std::clamp(1 - 0.5 * curvature(distance, x, step) * s, 0.5, 2.0);
}

}  // namespace corpuscle::bodies
