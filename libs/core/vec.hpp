// Vectors in space. Every length is in metres, every velocity in metres per second: SI inside, units only at the
// border.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <numbers>

namespace corpuscle {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Index3 = std::array<int, 3>;

// Radius [m] of the sphere of this volume [m^3].
inline double radiusOfSphere(double volume) { return std::cbrt(3 * volume / (4 * std::numbers::pi)); }

}  // namespace corpuscle
