// Axes start in directions uniform on the sphere, and turn as neighbouring cells push. Flat cells that are packed
// closely end up more parallel than they started; cellPack reports the order parameter of the result.
#pragma once
#include "packing/orientation.hpp"

namespace corpuscle::packing {

struct RandomOrientation : Orientation {
    Vec3 draw(Random& random) const override { return random.direction(); }
    bool mayTurn() const override { return true; }
    static const Schema<RandomOrientation>& schema();
};

}  // namespace corpuscle::packing
