// Diffusion between fluid particles on one side of a membrane: the flux from i to j is proportional to
//     V_i V_j F (c_i - c_j),   F = -W'(r)/r,   j on i's side
// so that what leaves one particle enters the other, and nothing leaves towards walls, nodes and bodies.
//
// record | that of sidedRecords.hpp, with the concentration c as its quantity
// sums   | sum V_i V_j F (c_j - c_i), two unused sums, sum V_i V_j F, without the factor of the kernel's gradient
#pragma once
#include "particles/simd.hpp"

namespace corpuscle::sph {

struct DiffusionConstants {};

template <class Kernel>
struct DiffusionPair {
    static constexpr int volume = 3, quantity = 4, side = 5, fields = 6;
    DiffusionConstants c;

    template <class V, class J>
    CORPUSCLE_INLINE void pair(const V (&i)[fields], const J* j, const V (&)[3], const V& q, V (&p)[4]) const {
        const V across = i[side] - V(j[side]), all = Kernel::template slope<V>(q) * (i[volume] * V(j[volume]));
        const V weight = whereNegative(across * across - V(0.5), all, V(0.0));
        p[0] = weight * (i[quantity] - V(j[quantity]));
        p[1] = p[2] = V(0.0);
        p[3] = weight;
    }

    template <class V>
    CORPUSCLE_INLINE void finish(const V (&)[fields], V (&)[4]) const {}
};

}  // namespace corpuscle::sph
