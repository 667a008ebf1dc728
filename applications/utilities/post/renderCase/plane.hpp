// A plane across one of the axes.
#pragma once
#include <string>

#include "core/vec.hpp"

namespace corpuscle {

struct Plane {
    int axis = 1;         // of the normal
    double position = 0;  // m
    int first() const { return axis == 0 ? 1 : 0; }
    int second() const { return axis == 2 ? 1 : 2; }
    Vec3 normal() const { return Vec3::Unit(axis); }
    std::string axisName() const { return std::string(1, "xyz"[axis]); }
};

}  // namespace corpuscle
