// All cells of a type have the same axis and keep it.
#pragma once
#include "packing/orientation.hpp"

namespace corpuscle::packing {

struct AlignedOrientation : Orientation {
    Vec3 axis = Vec3::UnitZ();  // of any length above 0

    Vec3 draw(Random& /*random*/) const override { return axis.normalized(); }
    bool mayTurn() const override { return false; }
    static const Schema<AlignedOrientation>& schema();
};

}  // namespace corpuscle::packing
