// Wendland's C2 kernel in three dimensions:
//     W(q) = 21/(2 pi H^3) (1 + 4q)(1 - q)^4,   q = r/H <= 1
//     -W'(r)/r = 210/(pi H^5) (1 - q)^3
// Source: H. Wendland, Advances in Computational Mathematics 4 (1995) 389.
#pragma once
#include <numbers>

#include "particles/simd.hpp"

namespace corpuscle::sph {

struct WendlandC2 {
    static constexpr const char *name = "wendlandC2", *text = "Wendland's C2 kernel, the default";
    static constexpr double defaultSupport = 3.0,
                            correctedSupport = 2.4;  // in spacings; correctedSupport: with corrected operators

    static double normalisation(double H) { return 21 / (2 * std::numbers::pi * H * H * H); }
    static double gradientNormalisation(double H) { return 20 * normalisation(H) / (H * H); }
    template <class V>
    static CORPUSCLE_INLINE V value(V q) {
        const V s = max(V(1.0) - q, V(0.0)), s2 = s * s;
        return (V(1.0) + V(4.0) * q) * s2 * s2;
    }
    template <class V>
    static CORPUSCLE_INLINE V slope(V q) {
        const V s = max(V(1.0) - q, V(0.0));
        return s * s * s;
    }
};

}  // namespace corpuscle::sph
