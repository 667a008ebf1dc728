// The simulated box: an axis-aligned cuboid [low, high), periodic along the chosen axes.
#pragma once
#include <array>
#include <cmath>

#include "core/vec.hpp"

namespace corpuscle::particles {

struct Box {
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();
    std::array<bool, 3> periodic{false, false, false};

    Vec3 size() const { return high - low; }
    Vec3 middle() const { return 0.5 * (low + high); }
    double volume() const { return size().prod(); }

    // The image of p inside the box, along periodic axes only.
    Vec3 wrap(Vec3 p) const {
        for (int k = 0; k < 3; ++k)
            if (periodic[k]) p[k] = wrap(p[k], k);
        return p;
    }
    double wrap(double p, int k) const {
        const double length = high[k] - low[k];
        if (p >= low[k] && p < high[k]) return p;
        p -= length * std::floor((p - low[k]) / length);
        return p < high[k] ? p : low[k];  // rounding may land on the upper face
    }
    // The shortest of all images of the difference d.
    Vec3 minimumImage(Vec3 d) const {
        for (int k = 0; k < 3; ++k)
            if (periodic[k]) {
                const double length = high[k] - low[k];
                d[k] -= length * std::nearbyint(d[k] / length);
            }
        return d;
    }
};

// Squared distance from p to the cuboid [low, high] (0 inside).
inline double distanceSquared(const Vec3& p, const Vec3& low, const Vec3& high) {
    return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
}

}  // namespace corpuscle::particles
