#include "sph/flow.hpp"

namespace corpuscle::sph {

const Schema<WallSettings>& WallSettings::schema() {
    static const Schema<WallSettings> s = Schema<WallSettings>("walls", "two parallel walls at the ends of the box")
                                              .word("normal", &WallSettings::normal, {"x", "y", "z"},
                                                    "axis that the walls are normal to", {.fallback = "z"});
    return s;
}

const Schema<InertiaSettings>& InertiaSettings::schema() {
    static const Schema<InertiaSettings> s =
        Schema<InertiaSettings>("inertia", "density set by a Reynolds number")
            .quantity("Re", &InertiaSettings::Re, unit::none, "rho gammadot a^2/mu; sets the density",
                      {.range = positive});
    return s;
}

}  // namespace corpuscle::sph
