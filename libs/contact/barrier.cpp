#include "contact/barrier.hpp"

#include <cmath>
#include <limits>

#include "core/registry.hpp"

namespace corpuscle::contact {

ContactLaw::Value Barrier::at(double gap) const {
    if (gap >= length) return {};
    const double s = gap / length;
    if (!(s > 0)) {
        constexpr double infinite = std::numeric_limits<double>::infinity();
        return {infinite, -infinite, infinite};
    }
    const double left = 1 - s, logarithm = std::log(s), ratio = left / s;
    return {-strength * left * left * logarithm, strength / length * left * (2 * logarithm - ratio),
            strength / (length * length) * (-2 * logarithm + ratio * (4 + ratio))};
}

const Schema<Barrier>& Barrier::schema() {
    static const Schema<Barrier> s =
        Schema<Barrier>("barrier", "surfaces repel each other, without limit as their gap closes")
            .quantity("reach", &Barrier::length, unit::metre, "gap at which contact begins", {.range = positive})
            .quantity("strength", &Barrier::strength, unit::newtonPerMetre, "energy per area of the barrier",
                      {.range = positive})
            .quantity("thickness", &Barrier::thickness, unit::metre,
                      "distance of the meshes at which the surfaces touch", {.fallback = "0 m", .range = nonNegative});
    return s;
}

CORPUSCLE_REGISTER(ContactLaw, Barrier, "barrier", "surfaces repel each other, without limit as their gap closes");

}  // namespace corpuscle::contact
