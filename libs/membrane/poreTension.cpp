#include "membrane/poreTension.hpp"

#include <algorithm>

#include "core/registry.hpp"
#include "membrane/diagnostics.hpp"

namespace corpuscle::membrane {

std::vector<double> PoreTension::atRest(const Network& network, const MembraneSettings& laws,
                                        std::span<const Vec3> x) const {
    std::vector<double> shares = nodeMeans(network, isotropicTensions(network, laws, x), x);
    for (double& T : shares) T = std::clamp((T - onset) / modulus, 0.0, 1.0);
    return shares;
}

const Schema<PoreTension>& PoreTension::schema() {
    static const Schema<PoreTension> s =
        Schema<PoreTension>("tension", "pores in proportion to the tension beyond an onset")
            .quantity("onset", &PoreTension::onset, unit::newtonPerMetre, "isotropic tension from which pores open",
                      {.range = nonNegative})
            .quantity("modulus", &PoreTension::modulus, unit::newtonPerMetre,
                      "tension beyond the onset over the share of the area that is pores", {.range = positive})
            .include<PoreLaw>();
    return s;
}

CORPUSCLE_REGISTER(PoreLaw, PoreTension, "tension", "pores by isotropic tension beyond an onset");

}  // namespace corpuscle::membrane
