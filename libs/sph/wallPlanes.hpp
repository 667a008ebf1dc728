// Two parallel plane walls as a pair law sees them: n.x = middle +- half, lengths as in the records.
//
// The particles behind a wall's surface take the velocity that continues the profile linearly, so that it vanishes
// (relative to the wall) on the surface (Morris, Fox, Zhu, J. Comput. Phys. 136 (1997) 214): their pairs with the fluid
// are multiplied by
//     beta = min(betaMax, 1 + depth_wall/distance_fluid)
#pragma once
#include "particles/simd.hpp"

namespace corpuscle::sph {

struct WallPlanes {
    double normal[3] = {0, 0, 0}, middle = 0, half = 0;  // half is far away where there are none
    double smallestDistance = 0, betaMax = 1;            // bounds of beta's quotient

    // Distance from the nearer wall's surface: above 0 in the fluid, below 0 behind it.
    template <class T>
    CORPUSCLE_INLINE T gap(const T* x) const {
        const T height = x[0] * T(normal[0]) + x[1] * T(normal[1]) + x[2] * T(normal[2]) - T(middle);
        return T(half) - particles::max(height, T(0) - height);
    }
    template <class V, class J>
    CORPUSCLE_INLINE V beta(const V& gapI, const J& gapJ) const {
        using particles::max;
        const V depthI = max(V(0.0) - gapI, V(0.0)), distanceI = max(gapI, V(smallestDistance));
        const J depthJ = max(J(0) - gapJ, J(0)), distanceJ = max(gapJ, J(smallestDistance));
        return min(V(1.0) + V(depthJ) / distanceI + depthI * V(J(1) / distanceJ), V(betaMax));
    }
};

}  // namespace corpuscle::sph
