// Family of the ways in which cells that are packed are turned.
#pragma once
#include "core/random.hpp"
#include "core/registry.hpp"

namespace corpuscle::packing {

class Orientation {
  public:
    static constexpr const char* familyName = "orientation";
    virtual ~Orientation() = default;
    virtual Vec3 draw(Random& random) const = 0;  // direction of the symmetry axis of one cell at first
    virtual bool mayTurn() const = 0;             // whether others may turn it while cells make room for each other
};

}  // namespace corpuscle::packing
