// Skalak's sheet, for the membrane of a red cell (Skalak, Tozeren, Zarda and Chien, Biophys. J. 13:245, 1973)
//     W = Gs/4 (I1^2 + 2 I1 - 2 I2 + C I2^2)
// symbol | meaning                                           | unit
// Gs     | shear modulus                                     | N/m
// C      | resistance to a change of area, Ks = (1 + 2 C) Gs | -
// Ks     | area modulus, in place of C                       | N/m
// Poisson's ratio C/(1 + C). The sheet stiffens at large strain. The C of a red cell itself is 1e4 and more; values of
// 10 to 100 hold its area to a few per cent and still allow a usable time step. A sphere inflated from the radius a to
// l a has the pressure 2 (l - 1/l + C l (l^4 - 1)) Gs/a.
#pragma once
#include <optional>

#include "core/settings.hpp"
#include "membrane/invariantLaw.hpp"

namespace corpuscle::membrane {

struct Skalak final : InvariantLawOf<Skalak> {
    double Gs = 0;             // N/m
    std::optional<double> C;   // -
    std::optional<double> Ks;  // N/m

    double areaNumber() const { return C ? *C : 0.5 * (*Ks / Gs - 1); }
    double W(double i1, double i2) const { return 0.25 * Gs * (i1 * i1 + 2 * (i1 - i2) + areaNumber() * i2 * i2); }
    std::array<double, 2> firstDerivatives(double i1, double i2) const {
        return {0.5 * Gs * (i1 + 1), 0.5 * Gs * (areaNumber() * i2 - 1)};
    }
    std::array<double, 3> secondDerivatives(double, double) const { return {0.5 * Gs, 0, 0.5 * Gs * areaNumber()}; }
    std::string constants() const override;
    static const Schema<Skalak>& schema();
};

}  // namespace corpuscle::membrane
