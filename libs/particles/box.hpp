// The simulated box: an axis-aligned cuboid [low, high), periodic along the chosen axes.
#pragma once
#include <array>
#include <cmath>

#include "core/periodicity.hpp"

namespace corpuscle::particles {

struct Box {
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();
    std::array<bool, 3> periodic{false, false, false};

    Vec3 size() const { return high - low; }
    Vec3 middle() const { return 0.5 * (low + high); }
    double volume() const { return size().prod(); }

    Periodicity periodicity() const { return {low, high, periodic}; }
    // The coordinate p along axis k, moved into the box by whole periods, as if the box were periodic along this axis.
    double wrap(double p, int k) const {
        const double length = high[k] - low[k];
        if (p >= low[k] && p < high[k]) return p;
        p -= length * std::floor((p - low[k]) / length);
        return p < high[k] ? p : low[k];  // rounding may land on the upper face
    }
};

// Squared distance from p to the cuboid [low, high] (0 inside).
inline double distanceSquared(const Vec3& p, const Vec3& low, const Vec3& high) {
    return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
}

}  // namespace corpuscle::particles
