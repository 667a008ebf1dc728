// Kernel `modelName` in three dimensions:
//     W(q) = 315/(64 pi H^3) (1 - q^2)^3,   q = r/H <= 1
//     -W'(r)/r = 945/(32 pi H^5) (1 - q^2)^2
// Source:
#pragma once
#include <numbers>

#include "particles/simd.hpp"

namespace corpuscle::sph {

struct ModelName {
    static constexpr const char *name = "modelName", *text = "a kernel";
    static constexpr double defaultSupport = 2.8, correctedSupport = 2.4;  // in particle spacings

    static double normalisation(double H) { return 315 / (64 * std::numbers::pi * H * H * H); }
    static double gradientNormalisation(double H) { return 6 * normalisation(H) / (H * H); }
    // W = normalisation value(q), -W'/r = gradientNormalisation slope(q); both vanish for q >= 1.
    template <class V>
    static CORPUSCLE_INLINE V value(V q) {
        const V s = max(V(1.0) - q * q, V(0.0));
        return s * s * s;
    }
    template <class V>
    static CORPUSCLE_INLINE V slope(V q) {
        const V s = max(V(1.0) - q * q, V(0.0));
        return s * s;
    }
};

}  // namespace corpuscle::sph
