#include "core/periodicity.hpp"

#include <stdexcept>

namespace corpuscle {

Periodicity::Periodicity(const Vec3& low, const Vec3& high, const std::array<bool, 3>& along)
    : low_(low), high_(high), length_(high - low) {
    for (int k = 0; k < 3; ++k)
        if (!along[static_cast<std::size_t>(k)]) length_[k] = 0;
}

void Periodicity::slide(int axis, const Vec3& offset, const Vec3& velocity) {
    if (!isAlong(axis) || offset[axis] != 0 || velocity[axis] != 0)
        throw std::logic_error("images slide across a periodic axis, and not along it");
    sliding_ = axis, offset_ = offset, slide_ = velocity;
}

}  // namespace corpuscle
