// Mean of a quantity a around a particle, over particles on its side of membranes (Shepard):
//     <a>_i = a_i + sum_j V_j W_ij (a_j - a_i)/(V_i W(0) + sum_j V_j W_ij),   j on i's side
// Noise decreases with the number of neighbours; a smooth field changes by an error of second order in H_s.
//
// record | x y z in supports (pairLoop.hpp) | volume V = m/rho, in any unit | a | side, any whole number
// sums   | sum V_i V_j W (a_j - a_i), two unused sums, sum V_i V_j W
#pragma once
#include "particles/simd.hpp"

namespace corpuscle::sph {

struct MeanConstants {};

template <class Kernel>
struct MeanPair {
    static constexpr int volume = 3, quantity = 4, side = 5, fields = 6;
    MeanConstants c;

    template <class V, class J>
    CORPUSCLE_INLINE void pair(const V (&i)[fields], const J* j, const V (&)[3], const V& q, V (&p)[4]) const {
        const V across = i[side] - V(j[side]), all = Kernel::template value<V>(q) * (i[volume] * V(j[volume]));
        const V weight = whereNegative(across * across - V(0.5), all, V(0.0));
        p[0] = weight * (i[quantity] - V(j[quantity]));
        p[1] = p[2] = V(0.0);
        p[3] = weight;
    }

    template <class V>
    CORPUSCLE_INLINE void finish(const V (&i)[fields], V (&sum)[4]) const {
        const V own = i[volume] * i[volume] * Kernel::template value<V>(V(0.0));
        sum[0] = i[quantity] + sum[0] / (own + sum[3]);
    }
};

}  // namespace corpuscle::sph
