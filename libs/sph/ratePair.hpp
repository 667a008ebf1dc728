// Viscous force and divergence of a velocity (operators.hpp), where viscosity is uniform:
//     (L u)_i = sum_j w_ij (u_i - u_j),   w_ij = V_i V_j F (s_i + s_j) beta
//     V_i (D u)_i = sum_j V_i V_j F (B_i d).(u_j - u_i),   d = x_j - x_i,  F = -W'(r)/r
// beta is the factor at walls (noSlip.hpp). Two wall particles do not act on each other.
//
// record | x y z in supports | u (3) | V in units of `volume`, negative for wall particles | s | B (xx yy zz xy xz yz)
//        | unused here | gap in supports
// sums   | -(L u) (3), V D u
#pragma once
#include "sph/noSlip.hpp"

namespace corpuscle::sph {

template <class Kernel, bool atWall>
struct RatePair {
    static constexpr int velocity = 3, volume = 6, scale = 7, correction = 8, gap = 15;
    static constexpr int fields = 16;  // one cache line of floats
    static constexpr bool distinct = true;
    NoSlip noSlip;

    // V_i V_j F and w_ij.
    template <class V, class J>
    static CORPUSCLE_INLINE void weights(const NoSlip& noSlip, const V (&i)[fields], const J* j, const V& q, V& F,
                                         V& w) {
        F = Kernel::template slope<V>(q) * (i[volume] * V(j[volume]));
        w = F * (i[scale] + V(j[scale]));
        if constexpr (atWall) {
            const V gapI = i[gap];
            const J gapJ(j[gap]);
            if (particles::anyNegative(min(gapI, i[volume])) || particles::anyNegative(gapJ) ||
                particles::anyNegative(J(j[volume]))) {
                const V both = max(i[volume], V(j[volume]));  // negative for two wall particles
                F = whereNegative(both, V(0.0), max(F, V(0.0) - F));
                w = whereNegative(both, V(0.0), max(w, V(0.0) - w)) * noSlip.beta(gapI, gapJ);
            }
        }
    }

    template <class V, class J>
    CORPUSCLE_INLINE void pair(const V (&i)[fields], const J* j, const V (&d)[3], const V& q, V (&p)[5]) const {
        V F, w;
        weights(noSlip, i, j, q, F, w);
        V du[3];
        for (int k = 0; k < 3; ++k) {
            du[k] = V(j[velocity + k]) - i[velocity + k];
            p[k] = V(0.0) - w * du[k];
        }
        p[3] = F * product(j + correction, d, du);
        p[4] = F * product(i + correction, d, du);
    }

  private:
    // (B d).u
    template <class T, class V>
    static CORPUSCLE_INLINE V product(const T* B, const V (&d)[3], const V (&u)[3]) {
        const V x = V(B[0]) * d[0] + V(B[3]) * d[1] + V(B[4]) * d[2];
        const V y = V(B[3]) * d[0] + V(B[1]) * d[1] + V(B[5]) * d[2];
        const V z = V(B[4]) * d[0] + V(B[5]) * d[1] + V(B[2]) * d[2];
        return x * u[0] + y * u[1] + z * u[2];
    }
};

}  // namespace corpuscle::sph
