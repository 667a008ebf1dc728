// A wall: a surface, its velocity, and its number, by which forces, budget and tables refer to it.
#pragma once
#include <memory>
#include <string>

#include "boundary/surface.hpp"

namespace corpuscle::boundary {

struct Wall {
    int number = 0;    // from 0
    std::string name;  // in tables and messages, such as "lower"
    std::shared_ptr<const Surface> surface;
    Vec3 velocity = Vec3::Zero();  // [m/s]; tangential: the surface stays where it is

    double distance(const Vec3& x) const { return surface->distance(x); }
    Vec3 normal(const Vec3& x) const { return surface->normal(x); }
    Vec3 velocityAt(const Vec3& /*x*/) const { return velocity; }
};

}  // namespace corpuscle::boundary
