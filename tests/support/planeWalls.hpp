// Two plane walls for scenes that tests put together by hand.
#pragma once
#include <memory>

#include "boundary/planeWalls.hpp"

namespace corpuscle::boundary::testing {

// Walls normal to an axis, at low and high; lower and upper are their velocities.
inline Walls planes(int axis, double low, double high, const Vec3& lower = Vec3::Zero(),
                    const Vec3& upper = Vec3::Zero(), double area = 1) {
    Walls walls;
    walls.add("lower", std::make_shared<Plane>(axis, low, 1, area));
    walls.add("upper", std::make_shared<Plane>(axis, high, -1, area));
    walls.setVelocity(0, lower), walls.setVelocity(1, upper);
    return walls;
}

}  // namespace corpuscle::boundary::testing
