// Quintic spline in three dimensions, H = 3 h:
// with t = 3q = r/h and the truncated powers (x)+ = max(0, x):
//     W = 1/(120 pi h^3) [ (3-t)+^5 - 6 (2-t)+^5 + 15 (1-t)+^5 ]
//     -W'(r)/r = 5/(120 pi h^5) [ (3-t)+^4 - 6 (2-t)+^4 + 15 (1-t)+^4 ] / t
// Source: Morris, Fox, Zhu, Journal of Computational Physics 136 (1997) 214.
#pragma once
#include <numbers>

#include "particles/simd.hpp"

namespace corpuscle::sph {

struct Quintic {
    static constexpr const char *name = "quintic", *text = "quintic spline";
    static constexpr double defaultSupport = 2.8, correctedSupport = 2.8;

    static double normalisation(double H) { return 27 / (120 * std::numbers::pi * H * H * H); }
    static double gradientNormalisation(double H) { return 5 * 9 * normalisation(H) / (H * H); }
    template <class V>
    static CORPUSCLE_INLINE V value(V q) {
        const V t = V(3.0) * q;
        const V a = max(V(3.0) - t, V(0.0)), b = max(V(2.0) - t, V(0.0)), c = max(V(1.0) - t, V(0.0));
        return power4(a) * a - V(6.0) * power4(b) * b + V(15.0) * power4(c) * c;
    }
    // The bracket vanishes like 24 t at the origin. The lower bound of t keeps the term of the particle itself finite,
    // which is then multiplied by a distance of zero.
    template <class V>
    static CORPUSCLE_INLINE V slope(V q) {
        const V t = V(3.0) * q;
        const V a = max(V(3.0) - t, V(0.0)), b = max(V(2.0) - t, V(0.0)), c = max(V(1.0) - t, V(0.0));
        return (power4(a) - V(6.0) * power4(b) + V(15.0) * power4(c)) / max(t, V(1e-6));
    }

  private:
    template <class V>
    static CORPUSCLE_INLINE V power4(V x) {
        const V s = x * x;
        return s * s;
    }
};

}  // namespace corpuscle::sph
