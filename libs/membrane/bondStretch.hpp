// Rupture by bond stretch (paper, section 2: bonds are removed beyond 1.05 times their rest length): a bond breaks
// permanently when
//     l/l0 > limit.
// symbol | meaning                  | unit
// limit  | greatest stretch of bond | -
#pragma once
#include "core/settings.hpp"
#include "membrane/ruptureLaw.hpp"

namespace corpuscle::membrane {

struct BondStretch : RuptureLaw {
    double limit = 0;

    std::vector<BrokenBond> select(const RuptureStep& now) const override {
        std::vector<BrokenBond> broken;
        for (const Bond& bond : now.network.bonds()) {
            const Vec3 &a = now.x[bond.node[0]], &b = now.x[bond.node[1]];
            if (const double stretch = (b - a).norm() / bond.rest; stretch > limit) {
                broken.push_back({bond.number, stretch, 0.5 * (a + b)});
            }
        }
        return broken;
    }
    static const Schema<BondStretch>& schema();
};

}  // namespace corpuscle::membrane
