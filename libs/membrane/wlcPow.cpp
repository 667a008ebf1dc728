#include "membrane/wlcPow.hpp"

#include <fmt/format.h>

#include "core/registry.hpp"

namespace corpuscle::membrane {

const Schema<WlcPow>& WlcPow::schema() {
    static const Schema<WlcPow> s =
        Schema<WlcPow>(
            "worm-like chain bond",
            "worm-like chain along each edge with a repulsive power, free of force at each edge's own length")
            .quantity("Gs", &WlcPow::Gs, unit::newtonPerMetre, "shear modulus of a hexagonal network",
                      {.range = positive})
            .quantity("persistenceLength", &WlcPow::persistenceLength, unit::metre, "persistence length of the chain",
                      {.range = positive})
            .quantity("kBT", &WlcPow::kBT, unit::joule, "thermal energy, here of 310.15 K",
                      {.fallback = "4.282e-21 J", .range = positive})
            .quantity("x0", &WlcPow::x0, unit::none, "rest length over contour length",
                      {.range = {.low = 0, .high = 1, .lowOpen = true, .highOpen = true}})
            .quantity("m", &WlcPow::m, unit::none, "exponent of the repulsive force",
                      {.fallback = "2", .range = {.low = 1, .lowOpen = true}})
            .boolean("scaled", &WlcPow::scaled, scaledText, {.fallback = "false"})
            .exactlyOneOf({"Gs", "persistenceLength"});
    return s;
}

std::string WlcPow::constants(double l0) const {
    return fmt::format("p {:.4g} m, lm {:.4g} m, kp {:.4g} N m^{:.4g}", kBT / spring().a(l0), l0 / x0, repulsion(l0),
                       m);
}

CORPUSCLE_REGISTER(BondLaw, WlcPow, "wlcPow", "worm-like chain with a repulsive power along each edge");

}  // namespace corpuscle::membrane
