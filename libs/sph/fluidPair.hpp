// Pressure, viscosity and continuity between two particles (paper, Eqs 5 and 6 put right), as accelerations:
//
//     du_i/dt   = sum_j m_j (p_i/rho_i^2 + p_j/rho_j^2) F x_ij  -  sum_j 2 mu_ij m_j/(rho_i rho_j) F beta u_ij
//     drho_i/dt = - sum_j m_j F x_ij . u_ij                      F = -W'(r)/r,  grad W = -F x_ij
//
// mu_ij is the uniform viscosity, or across a jump the harmonic mean 2 mu_i mu_j/(mu_i + mu_j) (Cleary and Monaghan,
// J. Comput. Phys. 148 (1999) 227). beta = 1 away from walls. At a plane wall the particles behind its surface take the velocity
// that continues the profile linearly, so that it vanishes (relative to the wall) on the surface (Morris, Fox, Zhu 1997):
//     beta = min(betaMax, 1 + depth_wall/distance_fluid)
//
// record | x y z | velocity (3) | p/rho^2 | e | mass, if it varies | viscosity, if it varies
//          e = sqrt(2 mu)/rho where mu is uniform, 1/rho where it varies; negative for wall particles: two of them do not act
//          on each other (the list leaves such pairs out only where a whole block is wall)
// What is uniform in the scene is a constant of the law, applied once to the sums.
#pragma once
#include "particles/simd.hpp"

namespace corpuscle::sph {

struct FluidConstants {
    double inverseSupport = 0;         // 1/H_s
    double gradientNormalisation = 0;  // of the kernel
    double mass = 0;                   // where uniform
    // Two parallel plane walls with normal n through n.x = middle +- half.
    double normal[3] = {0, 0, 0}, middle = 0, half = 0;
    double smallestDistance = 0, betaMax = 1;  // bounds of beta's quotient
};

template <class Kernel, bool varyingMass, bool varyingViscosity, bool atWall>
struct FluidPair {
    static constexpr int fields = 8 + (varyingMass ? 1 : 0) + (varyingViscosity ? 1 : 0);
    static constexpr int sums = 4;
    FluidConstants c;

    template <class V>
    CORPUSCLE_INLINE void pair(const V (&i)[fields], const double* j, V (&sum)[sums]) const {
        const V dx = i[0] - V(j[0]), dy = i[1] - V(j[1]), dz = i[2] - V(j[2]);
        const V r = sqrt(dx * dx + dy * dy + dz * dz);
        V F = Kernel::template slope<V>(r * V(c.inverseSupport));
        if constexpr (varyingMass) F = F * V(j[8]);
        if constexpr (atWall) F = whereNegative(max(i[7], V(j[7])), V(0.0), F);

        const V du = i[3] - V(j[3]), dv = i[4] - V(j[4]), dw = i[5] - V(j[5]);
        const V pressure = F * (i[6] + V(j[6]));
        V viscous = F * (i[7] * V(j[7]));
        if constexpr (varyingViscosity) {
            constexpr int at = varyingMass ? 9 : 8;
            viscous = viscous * (i[at] * V(4 * j[at])) / (i[at] + V(j[at]));
        }
        if constexpr (atWall) viscous = max(viscous, V(0.0) - viscous) * beta<V>(i, j);

        sum[0] += pressure * dx;
        sum[1] += pressure * dy;
        sum[2] += pressure * dz;
        sum[0] -= viscous * du;
        sum[1] -= viscous * dv;
        sum[2] -= viscous * dw;
        sum[3] -= F * (dx * du + dy * dv + dz * dw);
    }

    template <class V>
    CORPUSCLE_INLINE void finish(V (&sum)[sums]) const {
        const V scale(varyingMass ? c.gradientNormalisation : c.gradientNormalisation * c.mass);
        for (V& s : sum) s = s * scale;
    }

  private:
    template <class V>
    CORPUSCLE_INLINE V beta(const V (&i)[fields], const double* j) const {
        const V si = i[0] * V(c.normal[0]) + i[1] * V(c.normal[1]) + i[2] * V(c.normal[2]) - V(c.middle);
        const V gapI = V(c.half) - max(si, V(0.0) - si);  // above 0 in the fluid, below 0 behind the surface
        const double sj = j[0] * c.normal[0] + j[1] * c.normal[1] + j[2] * c.normal[2] - c.middle;
        const double gapJ = c.half - (sj > 0 ? sj : -sj);
        const V depthI = max(V(0.0) - gapI, V(0.0));
        const double depthJ = gapJ < 0 ? -gapJ : 0.0;
        const V distanceI = max(gapI, V(c.smallestDistance));
        const double distanceJ = gapJ > c.smallestDistance ? gapJ : c.smallestDistance;
        return min(V(1.0) + V(depthJ) / distanceI + depthI * V(1 / distanceJ), V(c.betaMax));
    }
};

}  // namespace corpuscle::sph
