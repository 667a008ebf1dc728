// Pressure, viscosity and continuity between two particles (paper, Eqs 5 and 6 corrected), as accelerations:
//
//     du_i/dt   = sum_j m_j (p_i/rho_i^2 + p_j/rho_j^2) F x_ij  -  sum_j 2 mu_ij m_j/(rho_i rho_j) F beta u_ij
//     drho_i/dt = - sum_j m_j F x_ij . u_ij                      F = -W'(r)/r,  grad W = -F x_ij
//
// mu_ij is the uniform viscosity, or across a jump the harmonic mean 2 mu_i mu_j/(mu_i + mu_j) (Cleary and Monaghan,
// J. Comput. Phys. 148 (1999) 227). beta is 1 away from walls; noSlip.hpp gives beta at walls.
//
// At a rigid body (libs/bodies) the velocity is continued linearly beyond the surface, as at walls, after subtraction
// of the rigid motion: with w = u_i - u_rigid(x_i), which vanishes on the surface, a body particle j below the surface
// is given the velocity
//     u_j - depth_j g_i,   g_i = w/distance_i
// where u_j is its rigid velocity. Fluid has depth 0 and body particles have g = 0, so that one antisymmetric
// expression covers both orders of a pair.
//
// record | x y z in supports (pairLoop.hpp) | velocity (3) | H_s p/rho^2 | e | mass / constants.mass, if it varies |
//                                                                            | viscosity, if it varies |
//          where there are walls or bodies: gap/H_s (noSlip.hpp) | where there are bodies: H_s g (3), depth/H_s
//          e = sqrt(2 mu)/rho where mu is uniform, 1/rho where it varies; negative for wall and body particles: two of
//              them do not act on each other (the list omits such pairs only where a whole block consists of them)
// What is uniform in the scene is a constant of the law, applied once to the sums. Where the mass varies, the pair
// terms are forces, which are equal and opposite.
#pragma once
#include "sph/noSlip.hpp"

namespace corpuscle::sph {

struct FluidConstants {
    double support = 0;                // H_s
    double gradientNormalisation = 0;  // of the kernel
    double mass = 0;                   // of a particle, or the unit of masses
    NoSlip noSlip;
};

// The boundaries in a scene; bodies: rigid bodies, with or without walls.
enum class Boundaries { none, walls, bodies };
constexpr int fieldsOf(Boundaries boundaries) {
    return boundaries == Boundaries::none ? 0 : boundaries == Boundaries::walls ? 1 : 5;
}

template <class Kernel, bool varyingMass, bool varyingViscosity, Boundaries boundaries, bool atWall>
struct FluidPair {
    static constexpr int gap = 8 + (varyingMass ? 1 : 0) + (varyingViscosity ? 1 : 0);
    static constexpr int slope = gap + 1;  // first field of H_s g
    static constexpr int fields = gap + fieldsOf(boundaries);
    static constexpr bool bodies = boundaries == Boundaries::bodies;
    FluidConstants c;

    template <class V, class J>
    CORPUSCLE_INLINE void pair(const V (&i)[fields], const J* j, const V (&d)[3], const V& q, V (&p)[4]) const {
        V F = Kernel::template slope<V>(q);
        if constexpr (varyingMass) F = F * (i[8] * V(j[8]));
        V viscous = F * (i[7] * V(j[7]));
        if constexpr (varyingViscosity) {
            constexpr int at = varyingMass ? 9 : 8;
            viscous = viscous * (i[at] * V(J(4) * j[at])) / (i[at] + V(j[at]));
        }
        [[maybe_unused]] V extra[3] = {V(0.0), V(0.0), V(0.0)};  // added to the velocity u_j - u_i, in viscosity only
        if constexpr (atWall && bodies) {
            if (particles::anyNegative(i[7]) || particles::anyNegative(J(j[7]))) {
                const V both = max(i[7], V(j[7]));
                F = whereNegative(both, V(0.0), F);
                viscous =
                    whereNegative(both, V(0.0), max(viscous, V(0.0) - viscous)) * c.noSlip.beta(i[gap], J(j[gap]));
                for (int k = 0; k < 3; ++k) extra[k] = i[slope + 3] * V(j[slope + k]) - i[slope + k] * V(j[slope + 3]);
            }
        } else if constexpr (atWall) {
            const V gapI = i[gap];
            const J gapJ(j[gap]);
            if (particles::anyNegative(gapJ) || particles::anyNegative(gapI)) {
                const V both = max(i[7], V(j[7]));  // negative for two wall particles
                F = whereNegative(both, V(0.0), F);
                viscous = whereNegative(both, V(0.0), max(viscous, V(0.0) - viscous)) * c.noSlip.beta(gapI, gapJ);
            }
        }

        const V pressure = F * (i[6] + V(j[6]));
        const V du[3] = {V(j[3]) - i[3], V(j[4]) - i[4], V(j[5]) - i[5]};
        if constexpr (atWall && bodies)
            for (int k = 0; k < 3; ++k) p[k] = pressure * d[k] - viscous * (du[k] + extra[k]);
        else
            for (int k = 0; k < 3; ++k) p[k] = pressure * d[k] - viscous * du[k];
        p[3] = F * (d[0] * du[0] + d[1] * du[1] + d[2] * du[2]);
    }

    template <class V>
    CORPUSCLE_INLINE void finish(const V (&i)[fields], V (&sum)[4]) const {
        V scale(c.gradientNormalisation * c.mass);
        if constexpr (varyingMass) scale = scale / i[8];
        for (int k = 0; k < 3; ++k) sum[k] = sum[k] * scale;
        sum[3] = V(0.0) - sum[3] * scale * V(c.support);
    }
};

}  // namespace corpuscle::sph
