// Rupture by tension: the sheet breaks where the greater principal tension of a triangle exceeds a limit,
//     T1 > limit.
// symbol | meaning                                                         | unit
// limit  | greatest principal tension                                      | N/m
// T1     | tension1 of bond and triangle laws (diagnostics.hpp)            | N/m
// Red cells lyse at some 10 mN/m of isotropic tension (Rand, Biophys. J. 4:303, 1964). This value presupposes their
// area modulus: a model sheet whose area modulus is smaller than a cell's reaches the strain of lysis at a smaller
// tension.
#pragma once
#include "core/settings.hpp"
#include "membrane/ruptureLaw.hpp"

namespace corpuscle::membrane {

struct PrincipalTension : RuptureLaw {
    double limit = 0;  // N/m

    std::vector<BrokenBond> select(const RuptureStep& now) const override;
    std::vector<double> excesses(const RuptureStep& now) const override;
    static const Schema<PrincipalTension>& schema();
};

}  // namespace corpuscle::membrane
