// Lucy's kernel (paper, Eq 3, normalised by the support radius):
//     W(q) = 105/(16 pi H^3) (1 + 3q)(1 - q)^3,   q = r/H <= 1
//     -W'(r)/r = 315/(4 pi H^5) (1 - q)^2
// Source: L. B. Lucy, Astronomical Journal 82 (1977) 1013.
#pragma once
#include <numbers>

#include "particles/simd.hpp"

namespace corpuscle::sph {

struct Lucy {
    static constexpr const char *name = "lucy", *text = "Lucy's kernel, the paper's choice";
    static constexpr double defaultSupport = 2.6,
                            correctedSupport = 2.4;  // in spacings; 2.6: least second-moment error near 80 neighbours

    static double normalisation(double H) { return 105 / (16 * std::numbers::pi * H * H * H); }
    static double gradientNormalisation(double H) { return 12 * normalisation(H) / (H * H); }
    // W = normalisation value(q), -W'/r = gradientNormalisation slope(q); both vanish for q >= 1.
    template <class V>
    static CORPUSCLE_INLINE V value(V q) {
        const V s = max(V(1.0) - q, V(0.0));
        return (V(1.0) + V(3.0) * q) * s * s * s;
    }
    template <class V>
    static CORPUSCLE_INLINE V slope(V q) {
        const V s = max(V(1.0) - q, V(0.0));
        return s * s;
    }
};

}  // namespace corpuscle::sph
