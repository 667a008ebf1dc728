// Random numbers from a seed, the same on every machine.
#pragma once
#include <cmath>
#include <cstdint>
#include <random>

#include "core/vec.hpp"

namespace corpuscle {

class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }  // in [0, 1)
    double between(double low, double high) { return low + (high - low) * uniform(); }
    // Uniform in a cuboid.
    Vec3 between(const Vec3& low, const Vec3& high) {
        Vec3 x;
        for (int k = 0; k < 3; ++k) x[k] = between(low[k], high[k]);
        return x;
    }
    // Uniform on the unit sphere: by rejection in the unit ball, so that the result does not depend on the rounding of
    // a library function.
    Vec3 direction() {
        for (;;) {
            const Vec3 x = between(Vec3(-1, -1, -1), Vec3(1, 1, 1));
            const double square = x.squaredNorm();
            if (square > 1e-4 && square <= 1) return x / std::sqrt(square);
        }
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace corpuscle
