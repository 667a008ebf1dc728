#include "membrane/arealStrain.hpp"

#include "core/registry.hpp"
#include "membrane/surface.hpp"

namespace corpuscle::membrane {

std::vector<BrokenBond> ArealStrain::select(const Network& network, const MembraneSettings&,
                                            std::span<const Vec3> x) const {
    std::vector<int> beyond;
    for (const int t : network.wholeTriangles()) {
        if (areaVector(x, network.triangles()[t]).norm() > (1 + limit) * network.restAreas()[t]) {
            beyond.push_back(t);
        }
    }
    return mostStretchedBonds(network, beyond, x);
}

const Schema<ArealStrain>& ArealStrain::schema() {
    static const Schema<ArealStrain> s =
        Schema<ArealStrain>("areal strain", "the sheet breaks where a triangle's area grows past a limit")
            .quantity("limit", &ArealStrain::limit, unit::none, "greatest A/A0 - 1 of a triangle", {.range = positive});
    return s;
}

CORPUSCLE_REGISTER(RuptureLaw, ArealStrain, "arealStrain", "the sheet breaks past an areal strain");

}  // namespace corpuscle::membrane
