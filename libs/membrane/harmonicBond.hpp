// Harmonic bond (paper, Eq 8, with the restoring sign)
//     E = k/2 (l - l0)^2         F_i = -k (l - l0) e,   e = (x_i - x_j)/l
// symbol | meaning                    | unit
// k      | spring constant            | N/m
// l0     | rest length, from the mesh | m
// On a hexagonal network: Gs = sqrt(3)/4 k, Ks = sqrt(3)/2 k, Young's modulus 2/sqrt(3) k, Poisson's ratio 1/3.
// Codes that write E = K (l - l0)^2 have k = 2 K.
#pragma once
#include "core/settings.hpp"
#include "membrane/bondLaw.hpp"
#include "membrane/harmonic.hpp"

namespace corpuscle::membrane {

struct HarmonicBond : BondLawOf<HarmonicBond>, Harmonic {
    std::string constants(double l0) const override;
    static const Schema<HarmonicBond>& schema();
};

}  // namespace corpuscle::membrane
