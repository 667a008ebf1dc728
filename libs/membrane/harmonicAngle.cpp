#include "membrane/harmonicAngle.hpp"

#include "core/registry.hpp"

namespace corpuscle::membrane {

const Schema<HarmonicAngle>& HarmonicAngle::schema() {
    static const Schema<HarmonicAngle> s =
        Schema<HarmonicAngle>("harmonic angle",
                              "three-point spring at each corner of each triangle, E = k/2 (theta - theta0)^2")
            .quantity("k", &HarmonicAngle::k, unit::joule, "angle constant (N m/rad)", {.range = positive});
    return s;
}

CORPUSCLE_REGISTER(AngleLaw, HarmonicAngle, "harmonic", "three-point spring at each corner of each triangle");

}  // namespace corpuscle::membrane
