// No slip at walls: the factor beta in pair laws.
//
// Particles behind a wall's surface are given the velocity that continues the profile linearly, so that the velocity
// relative to the wall vanishes on the surface (Morris, Fox, Zhu, J. Comput. Phys. 136 (1997) 214): the viscous terms
// of their pairs with the fluid are multiplied by
//     beta = min(betaMax, 1 + depth_wall/distance_fluid)
// A particle's gap, the signed distance from its nearest wall in supports, is a field of its record: above 0 in the
// fluid, below 0 behind the surface.
#pragma once
#include <algorithm>

#include "particles/simd.hpp"

namespace corpuscle::sph {

struct NoSlip {
    static constexpr double nowhere = 1e6;  // gap where there are no walls, in supports
    // The gap for this distance from the nearest wall; distance and support in metres.
    static double gap(double distance, double support) { return std::min(distance / support, nowhere); }

    // Bounds for the quotient in beta: a fluid particle that is very close to a wall counts as smallestDistance away,
    // in supports; betaMax bounds beta itself.
    double smallestDistance = 1, betaMax = 10;

    // spacing, support: dx, H_s [m]. In explicit steps beta shortens the viscous limit. What its bound leaves out of
    // the friction of a particle near the wall lets the fluid slip: where a curved wall cuts through the lattice of
    // particles, a tube 24 dx wide then carries 0.6 % too much, with the bounds of the implicit step 0.25 %.
    static NoSlip of(double spacing, double support) { return {0.25 * spacing / support, 10}; }
    static NoSlip ofImplicit(double spacing, double support) { return {0.02 * spacing / support, 200}; }

    template <class V, class J>
    CORPUSCLE_INLINE V beta(const V& gapI, const J& gapJ) const {
        using particles::max;
        const V depthI = max(V(0.0) - gapI, V(0.0)), distanceI = max(gapI, V(smallestDistance));
        const J depthJ = max(J(0) - gapJ, J(0)), distanceJ = max(gapJ, J(smallestDistance));
        return min(V(1.0) + V(depthJ) / distanceI + depthI * V(J(1) / distanceJ), V(betaMax));
    }
};

}  // namespace corpuscle::sph
