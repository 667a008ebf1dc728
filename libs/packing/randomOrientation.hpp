// Cells begin with axes uniform on the sphere, and turn as their neighbours push them. Flat cells that are packed
// closely lie more in parallel than they began; cellPack reports the order parameter that is left.
#pragma once
#include "packing/orientation.hpp"

namespace corpuscle::packing {

struct RandomOrientation : Orientation {
    Vec3 draw(Random& random) const override { return random.direction(); }
    bool mayTurn() const override { return true; }
    static const Schema<RandomOrientation>& schema();
};

}  // namespace corpuscle::packing
