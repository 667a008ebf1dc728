// Rupture by areal strain: the sheet breaks where the area A of a triangle exceeds its stress-free area A0 too much,
//     A/A0 - 1 > limit.
// symbol | meaning               | unit
// limit  | greatest areal strain | -
// Red cells lyse at 2 to 4 % (Evans, Waugh and Melnik, Biophys. J. 16:585, 1976).
#pragma once
#include "core/settings.hpp"
#include "membrane/ruptureLaw.hpp"

namespace corpuscle::membrane {

struct ArealStrain : RuptureLaw {
    double limit = 0;

    std::vector<BrokenBond> select(const RuptureStep& now) const override;
    std::vector<double> excesses(const RuptureStep& now) const override;
    static const Schema<ArealStrain>& schema();
};

}  // namespace corpuscle::membrane
