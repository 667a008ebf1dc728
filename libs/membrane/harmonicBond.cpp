#include "membrane/harmonicBond.hpp"

#include <fmt/format.h>

#include "core/registry.hpp"

namespace corpuscle::membrane {

const Schema<HarmonicBond>& HarmonicBond::schema() {
    static const Schema<HarmonicBond> s =
        Schema<HarmonicBond>(
            "harmonic bond",
            "linear spring along each edge, E = k/2 (l - l0)^2; on a hexagonal network Gs = sqrt(3)/4 k")
            .quantity("k", &HarmonicBond::k, unit::newtonPerMetre, "spring constant", {.range = positive})
            .boolean("scaled", &HarmonicBond::scaled, scaledText, {.fallback = "false"});
    return s;
}

std::string HarmonicBond::constants(double) const { return fmt::format("k {:.4g} N/m", k); }

CORPUSCLE_REGISTER(BondLaw, HarmonicBond, "harmonic", "linear spring along each edge");

}  // namespace corpuscle::membrane
