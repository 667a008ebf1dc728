// The transposes of the divergence and the gradient of ratePair.hpp and gradientPair.hpp:
//     f_i = - sum_j V_i V_j F (T_i + T_j) d,   d = x_j - x_i,  F = -W'(r)/r
// With T = p B, f is D^T V p, the force of the pressure p; with T = -tau B, f is the force of a stress tau, and T is
// 3 x 3 and not symmetric. Two wall particles do not act on each other.
//
// record | x y z in supports | V in units of `volume`, negative for wall particles | T: xx yy zz xy xz yz, or by rows
// sums   | f (3), unused
#pragma once
#include "sph/noSlip.hpp"

namespace corpuscle::sph {

template <class Kernel, bool symmetric, bool atWall>
struct StressPair {
    static constexpr int volume = 3, stress = 4, numbers = symmetric ? 6 : 9, fields = stress + numbers;
    NoSlip noSlip;  // the constants of ratePair.hpp; not used here

    template <class V, class J>
    CORPUSCLE_INLINE void pair(const V (&i)[fields], const J* j, const V (&d)[3], const V& q, V (&p)[4]) const {
        V F = Kernel::template slope<V>(q) * (i[volume] * V(j[volume]));
        if constexpr (atWall) {
            const V both = max(i[volume], V(j[volume]));
            F = whereNegative(both, V(0.0), max(F, V(0.0) - F));
        }
        V s[numbers];
        for (int k = 0; k < numbers; ++k) s[k] = i[stress + k] + V(j[stress + k]);
        constexpr int at[3][3] = {{0, symmetric ? 3 : 1, symmetric ? 4 : 2},
                                  {3, symmetric ? 1 : 4, 5},
                                  {symmetric ? 4 : 6, symmetric ? 5 : 7, symmetric ? 2 : 8}};
        for (int k = 0; k < 3; ++k) p[k] = F * (s[at[k][0]] * d[0] + s[at[k][1]] * d[1] + s[at[k][2]] * d[2]);
        p[3] = V(0.0);
    }
};

}  // namespace corpuscle::sph
