// A streamline, the line along the velocity at one instant, through a seed.
//
//     dx/ds = u(x)/|u(x)|,   s the length along the line,
//
// by the classical fourth-order Runge-Kutta scheme with steps of constant length; where the fluid ends, steps are
// halved down to a 32nd, so that the line reaches as far as the fluid.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/vec.hpp"

namespace corpuscle {

// The velocity [m/s]; NaN outside the fluid.
using VelocityAt = std::function<Vec3(const Vec3&)>;

struct Streamline {
    // closed: back at the seed, within two steps; period: displaced from the seed by a period of the flow; outside: at
    // a wall, a body or another end of the fluid; still: where the velocity vanishes or turns round within a step;
    // length: at the greatest length.
    enum class End { closed, period, outside, still, length };
    std::vector<Vec3> points;  // downstream, one step apart [m]; contiguous across periodic faces
    std::size_t seed = 0;      // number of the seed among the points
    End downstream = End::length;
    std::optional<End> upstream;  // empty: the line begins at its seed

    double length() const;  // m
};
std::string nameOf(Streamline::End end);

struct Tracing {
    double step, longest;         // of the line downstream and upstream of its seed [m]
    Vec3 periods = Vec3::Zero();  // of the flow [m]; 0 along an axis without a period
};

// Follows the line downstream until it is closed, covers a period or is as long as it may be. If the fluid ends before
// that, the line is followed upstream too. The seed must lie in the fluid.
Streamline trace(const VelocityAt& velocity, const Vec3& seed, const Tracing& tracing);

}  // namespace corpuscle
