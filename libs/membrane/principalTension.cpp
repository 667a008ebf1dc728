#include "membrane/principalTension.hpp"

#include "core/registry.hpp"
#include "membrane/diagnostics.hpp"

namespace corpuscle::membrane {

std::vector<BrokenBond> PrincipalTension::select(const Network& network, const MembraneSettings& laws,
                                                 std::span<const Vec3> x) const {
    const std::vector<double> tension = principalTensions(network, laws, x).tension1;
    std::vector<int> beyond;
    for (const int t : network.wholeTriangles()) {
        if (tension[static_cast<std::size_t>(t)] > limit) {
            beyond.push_back(t);
        }
    }
    return mostStretchedBonds(network, beyond, x);
}

const Schema<PrincipalTension>& PrincipalTension::schema() {
    static const Schema<PrincipalTension> s =
        Schema<PrincipalTension>("principal tension",
                                 "the sheet breaks where its greater principal tension passes a limit")
            .quantity("limit", &PrincipalTension::limit, unit::newtonPerMetre, "greatest principal tension",
                      {.range = positive});
    return s;
}

CORPUSCLE_REGISTER(RuptureLaw, PrincipalTension, "tension", "the sheet breaks past a principal tension");

}  // namespace corpuscle::membrane
