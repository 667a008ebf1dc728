// How evenly the neighbours of a particle lie around it:
//     C_i = sum_j V_j F x_ij = - sum_j V_j grad W_ij,    sigma_i = sum_j V_j W_ij
// C vanishes on a lattice and points from where particles are dense to where they are sparse: shifting follows it.
//
// record | x y z | volume V = m/rho [m^3]
#pragma once
#include "particles/simd.hpp"

namespace corpuscle::sph {

struct DisorderConstants {
    double inverseSupport = 0, normalisation = 0, gradientNormalisation = 0;
};

template <class Kernel>
struct DisorderPair {
    static constexpr int fields = 4, sums = 4;
    DisorderConstants c;

    template <class V>
    CORPUSCLE_INLINE void pair(const V (&i)[fields], const double* j, V (&sum)[sums]) const {
        const V dx = i[0] - V(j[0]), dy = i[1] - V(j[1]), dz = i[2] - V(j[2]);
        const V q = sqrt(dx * dx + dy * dy + dz * dz) * V(c.inverseSupport);
        const V VF = Kernel::template slope<V>(q) * V(j[3]);
        sum[0] += VF * dx;
        sum[1] += VF * dy;
        sum[2] += VF * dz;
        sum[3] += Kernel::template value<V>(q) * V(j[3]);
    }

    template <class V>
    CORPUSCLE_INLINE void finish(V (&sum)[sums]) const {
        for (int k = 0; k < 3; ++k) sum[k] = sum[k] * V(c.gradientNormalisation);
        sum[3] = sum[3] * V(c.normalisation);
    }
};

}  // namespace corpuscle::sph
