// How evenly the neighbours of a particle lie around it:
//     C_i = sum_j V_j F x_ij = - sum_j V_j grad W_ij,    sigma_i = sum_j V_j W_ij
// C vanishes on a lattice and points from where particles are dense to where they are sparse: shifting moves particles
// along C.
//
// record | x y z in supports (pairLoop.hpp) | volume V = m/rho [m^3]
#pragma once
#include "particles/simd.hpp"

namespace corpuscle::sph {

struct DisorderConstants {
    double support = 0, normalisation = 0, gradientNormalisation = 0;
};

template <class Kernel>
struct DisorderPair {
    static constexpr int fields = 4;
    DisorderConstants c;

    // The terms of the sums times V_i, which makes them symmetric in i and j.
    template <class V, class J>
    CORPUSCLE_INLINE void pair(const V (&i)[fields], const J* j, const V (&d)[3], const V& q, V (&p)[4]) const {
        const V volumes = i[3] * V(j[3]), F = Kernel::template slope<V>(q) * volumes;
        for (int k = 0; k < 3; ++k) p[k] = F * d[k];
        p[3] = Kernel::template value<V>(q) * volumes;
    }

    template <class V>
    CORPUSCLE_INLINE void finish(const V (&i)[fields], V (&sum)[4]) const {
        const V inverse = V(1.0) / i[3], gradient = V(c.gradientNormalisation * c.support) * inverse;
        for (int k = 0; k < 3; ++k) sum[k] = sum[k] * gradient;
        sum[3] = (sum[3] * inverse + i[3] * Kernel::template value<V>(V(0.0))) * V(c.normalisation);
    }
};

}  // namespace corpuscle::sph
