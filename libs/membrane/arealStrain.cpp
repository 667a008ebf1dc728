#include "membrane/arealStrain.hpp"

#include "core/registry.hpp"
#include "membrane/diagnostics.hpp"

namespace corpuscle::membrane {

std::vector<BrokenBond> ArealStrain::select(const RuptureStep& now) const {
    std::vector<int> beyond;
    for (const int t : now.network.wholeTriangles()) {
        if (arealStrain(now.network, t, now.x) > limit) {
            beyond.push_back(t);
        }
    }
    return mostStretchedBonds(now.network, beyond, now.x);
}

std::vector<double> ArealStrain::excesses(const RuptureStep& now) const {
    std::vector<double> all;
    for (const int t : now.network.wholeTriangles()) all.push_back(arealStrain(now.network, t, now.x) / limit - 1);
    return all;
}

const Schema<ArealStrain>& ArealStrain::schema() {
    static const Schema<ArealStrain> s =
        Schema<ArealStrain>("areal strain", "the sheet breaks where a triangle's area grows past a limit")
            .quantity("limit", &ArealStrain::limit, unit::none, "greatest A/A0 - 1 of a triangle", {.range = positive});
    return s;
}

CORPUSCLE_REGISTER(RuptureLaw, ArealStrain, "arealStrain", "the sheet breaks past an areal strain");

}  // namespace corpuscle::membrane
