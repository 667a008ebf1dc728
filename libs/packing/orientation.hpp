// Family of orientations of packed cells.
#pragma once
#include "core/random.hpp"
#include "core/registry.hpp"

namespace corpuscle::packing {

class Orientation {
  public:
    static constexpr const char* familyName = "orientation";
    virtual ~Orientation() = default;
    virtual Vec3 draw(Random& random) const = 0;  // initial direction of the symmetry axis of one cell
    virtual bool mayTurn() const = 0;             // whether contact with other cells may rotate the axis
};

}  // namespace corpuscle::packing
