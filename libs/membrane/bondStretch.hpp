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
            if (const double l = stretch(bond, now.x); l > limit) {
                broken.push_back({bond.number, l, 0.5 * (now.x[bond.node[0]] + now.x[bond.node[1]])});
            }
        }
        return broken;
    }
    std::vector<double> excesses(const RuptureStep& now) const override {
        std::vector<double> all;
        all.reserve(now.network.bonds().size());
        for (const Bond& bond : now.network.bonds()) all.push_back(stretch(bond, now.x) / limit - 1);
        return all;
    }
    static const Schema<BondStretch>& schema();

  private:
    static double stretch(const Bond& bond, std::span<const Vec3> x) {
        return (x[bond.node[1]] - x[bond.node[0]]).norm() / bond.rest;
    }
};

}  // namespace corpuscle::membrane
