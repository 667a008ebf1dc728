#include "membrane/fenePow.hpp"

#include <fmt/format.h>

#include "core/registry.hpp"

namespace corpuscle::membrane {

const Schema<FenePow>& FenePow::schema() {
    static const Schema<FenePow> s = Schema<FenePow>("finitely extensible bond",
                                                     "finitely extensible spring along each edge with a repulsive "
                                                     "power, free of force at each edge's own length")
                                         .quantity("Gs", &FenePow::Gs, unit::newtonPerMetre,
                                                   "shear modulus of a hexagonal network", {.range = positive})
                                         .quantity("ks", &FenePow::ks, unit::newtonPerMetre,
                                                   "spring constant at small extension", {.range = positive})
                                         .quantity("x0", &FenePow::x0, unit::none, "rest length over contour length",
                                                   {.range = {.low = 0, .high = 1, .lowOpen = true, .highOpen = true}})
                                         .quantity("m", &FenePow::m, unit::none, "exponent of the repulsive force",
                                                   {.fallback = "2", .range = {.low = 1, .lowOpen = true}})
                                         .boolean("scaled", &FenePow::scaled, scaledText, {.fallback = "false"})
                                         .exactlyOneOf({"Gs", "ks"});
    return s;
}

std::string FenePow::constants(double l0) const {
    return fmt::format("ks {:.4g} N/m, lm {:.4g} m, kp {:.4g} N m^{:.4g}", spring().a(l0) * x0 / l0, l0 / x0,
                       repulsion(l0), m);
}

CORPUSCLE_REGISTER(BondLaw, FenePow, "fenePow", "finitely extensible spring with a repulsive power along each edge");

}  // namespace corpuscle::membrane
