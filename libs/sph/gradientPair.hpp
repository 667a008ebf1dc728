// Viscous force and gradient of a velocity (operators.hpp), where viscosity varies:
//     (L u)_i = sum_j w_ij (u_i - u_j),   w_ij = V_i V_j F (s_i + s_j) beta m_ij
//     V_i sum_j V_j F d (u_j - u_i)^T,    d = x_j - x_i,  F = -W'(r)/r;  the gradient is B_i/V_i times this sum
// m_ij is the harmonic mean 2 m_i m_j/(m_i + m_j) of the layers' viscosities, 1 if viscosity does not vary in layers;
// beta is the factor at walls (noSlip.hpp). Two wall particles do not act on each other.
//
// record | as in ratePair.hpp; with layers also m, the viscosity in units of the fluid's
// sums   | -(L u) (3), unused, d_x du (3), d_y du (3), d_z du (3), unused (3)
#pragma once
#include "sph/ratePair.hpp"

namespace corpuscle::sph {

template <class Kernel, bool layered, bool atWall>
struct GradientPair {
    using Rate = RatePair<Kernel, atWall>;
    static constexpr int fields = Rate::fields, viscosity = 14, gradient = 4, sums = 16;
    NoSlip noSlip;

    template <class V, class J>
    CORPUSCLE_INLINE void pair(const V (&i)[fields], const J* j, const V (&d)[3], const V& q, V (&p)[sums]) const {
        V F, w;
        Rate::weights(noSlip, i, j, q, F, w);
        if constexpr (layered) w = w * (i[viscosity] * V(J(2) * j[viscosity])) / (i[viscosity] + V(j[viscosity]));
        for (V& sum : p) sum = V(0.0);
        for (int l = 0; l < 3; ++l) {
            const V du = V(j[Rate::velocity + l]) - i[Rate::velocity + l];
            p[l] = V(0.0) - w * du;
            for (int k = 0; k < 3; ++k) p[gradient + 3 * k + l] = F * d[k] * du;
        }
    }
};

}  // namespace corpuscle::sph
