// Moments of the neighbours of a particle, from which corrected operators are made (operators.hpp):
//     R = sum_j V_j F (1 + 0.2 (W/W(dx))^4) x_ij,  x_ij = x_i - x_j: vanishes where particles lie evenly; shifting
//         moves particles along R
//     M = sum_j V_j F x_ij x_ij^T            the unit matrix for an ideal arrangement of particles
//     sum_j V_j F,  sum_j V_j V_i F^2 r^2    for the diagonals of viscosity and of bulk stiffness
//     sigma = sum_j V_j W
// with F = -W'(r)/r, dx the spacing. The second term of R repels particles that are nearer than dx
// (coupling/transport.hpp). All sums are made in one pass; contributions of wall particles to each other are
// meaningless.
//
// record | x y z in supports (pairLoop.hpp) | volume V in units of `volume`
// sums   | R (3), M (xx yy zz xy xz yz), sum V F, sum V V F^2 r^2, sigma; each times V_i before `finish`
#pragma once
#include "particles/simd.hpp"

namespace corpuscle::sph {

struct MomentConstants {
    double support = 0, normalisation = 0, gradientNormalisation = 0;
    double volume = 0;     // unit of the records' volumes [m^3]
    double atSpacing = 0;  // Kernel::value at a distance of one spacing
};

struct Moments {
    enum Sum { shift = 0, second = 3, strength = 9, square = 10, number = 11, count = 12 };
};

template <class Kernel>
struct MomentPair {
    using enum Moments::Sum;
    static constexpr int fields = 4, sums = count;
    static constexpr double repulsion = 0.2;
    MomentConstants c;

    template <class V, class J>
    CORPUSCLE_INLINE void pair(const V (&i)[fields], const J* j, const V (&d)[3], const V& q, V (&p)[sums]) const {
        const V volumes = i[3] * V(j[3]), slope = Kernel::template slope<V>(q), F = slope * volumes;
        const V W = Kernel::template value<V>(q), ratio = W * V(1 / c.atSpacing), ratio2 = ratio * ratio,
                push = V(1.0) + V(repulsion) * ratio2 * ratio2;
        V Fd[3];
        for (int k = 0; k < 3; ++k) {
            Fd[k] = F * d[k];
            p[shift + k] = Fd[k] * push;
            p[second + k] = Fd[k] * d[k];
        }
        p[second + 3] = Fd[0] * d[1];
        p[second + 4] = Fd[0] * d[2];
        p[second + 5] = Fd[1] * d[2];
        p[strength] = F;
        p[square] = F * slope * q * q;
        p[number] = W * volumes;
    }

    template <class V>
    CORPUSCLE_INLINE void finish(const V (&i)[fields], V (&sum)[sums]) const {
        const V once = V(c.volume) / i[3];  // turns a sum of V_i V_j into one of V_j
        const double F = c.gradientNormalisation, H = c.support;
        for (int k = 0; k < 3; ++k) sum[shift + k] = sum[shift + k] * once * V(F * H);
        for (int k = 0; k < 6; ++k) sum[second + k] = sum[second + k] * once * V(F * H * H);
        sum[strength] = sum[strength] * once * V(F);
        sum[square] = sum[square] * V(c.volume * c.volume * F * F * H * H);
        sum[number] =
            (sum[number] * once + V(c.volume) * i[3] * Kernel::template value<V>(V(0.0))) * V(c.normalisation);
    }
};

}  // namespace corpuscle::sph
