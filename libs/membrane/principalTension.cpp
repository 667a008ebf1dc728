#include "membrane/principalTension.hpp"

#include "core/error.hpp"
#include "core/registry.hpp"
#include "membrane/diagnostics.hpp"

namespace corpuscle::membrane {

std::vector<BrokenBond> PrincipalTension::select(const RuptureStep& now) const {
    std::vector<int> beyond;
    for (const int t : now.network.wholeTriangles()) {
        if (principalTensions(now.network, now.laws, t, now.x).first > limit) {
            beyond.push_back(t);
        }
    }
    return mostStretchedBonds(now.network, beyond, now.x);
}

std::vector<double> PrincipalTension::excesses(const RuptureStep& now) const {
    constexpr double farBeyond = 1e3;
    std::vector<double> all;
    for (const int t : now.network.wholeTriangles()) {
        try {
            all.push_back(principalTensions(now.network, now.laws, t, now.x).first / limit - 1);
        } catch (
            const Failure&) {  // a bond beyond its contour length, in a step that is longer than the one to be made
            all.push_back(farBeyond);
        }
    }
    return all;
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
