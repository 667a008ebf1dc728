// The transpose of the divergence of ratePair.hpp, for a scalar p per particle:
//     (D^T V p)_i = - sum_j V_i V_j F (p_i B_i + p_j B_j) d,   d = x_j - x_i,  F = -W'(r)/r
// the force of the pressure p. Two wall particles do not act on each other.
//
// record | x y z in supports | V in units of `volume`, negative for wall particles | p B (xx yy zz xy xz yz)
// sums   | D^T V p (3), nothing
#pragma once
#include "sph/wallPlanes.hpp"

namespace corpuscle::sph {

template <class Kernel, bool atWall>
struct StressPair {
    static constexpr int volume = 3, stress = 4, fields = 10;
    WallPlanes walls;  // the constants of ratePair.hpp; not used here

    template <class V, class J>
    CORPUSCLE_INLINE void pair(const V (&i)[fields], const J* j, const V (&d)[3], const V& q, V (&p)[4]) const {
        V F = Kernel::template slope<V>(q) * (i[volume] * V(j[volume]));
        if constexpr (atWall) {
            const V both = max(i[volume], V(j[volume]));
            F = whereNegative(both, V(0.0), max(F, V(0.0) - F));
        }
        V s[6];
        for (int k = 0; k < 6; ++k) s[k] = i[stress + k] + V(j[stress + k]);
        p[0] = F * (s[0] * d[0] + s[3] * d[1] + s[4] * d[2]);
        p[1] = F * (s[3] * d[0] + s[1] * d[1] + s[5] * d[2]);
        p[2] = F * (s[4] * d[0] + s[5] * d[1] + s[2] * d[2]);
        p[3] = V(0.0);
    }
};

}  // namespace corpuscle::sph
