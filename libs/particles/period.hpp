// Periods of the box, as geometry asks for them (geometry/period.hpp): 0 along an axis that is not periodic.
#pragma once
#include "particles/box.hpp"

namespace corpuscle::particles {

inline Vec3 periodOf(const Box& box) {
    Vec3 period = box.size();
    for (int k = 0; k < 3; ++k)
        if (!box.periodic[static_cast<std::size_t>(k)]) period[k] = 0;
    return period;
}

}  // namespace corpuscle::particles
