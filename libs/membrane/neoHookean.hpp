// Neo-Hookean sheet: a thin layer of an incompressible rubber (Barthes-Biesel, Diaz and Dhenin, J. Fluid Mech. 460:211,
// 2002)
//     W = Gs/2 (l1^2 + l2^2 + 1/(l1 l2)^2 - 3) = Gs/2 (I1 - 1 + 1/(I2 + 1))
// symbol | meaning       | unit
// Gs     | shear modulus | N/m
// Ks = 3 Gs, Poisson's ratio 1/2. The sheet softens at large strain. A sphere inflated from the radius a to l a has the
// pressure 2 (1 - l^-6)/l Gs/a.
#pragma once
#include "core/settings.hpp"
#include "membrane/invariantLaw.hpp"

namespace corpuscle::membrane {

struct NeoHookean final : InvariantLawOf<NeoHookean> {
    double Gs = 0;  // N/m

    double W(double i1, double i2) const { return 0.5 * Gs * (i1 - i2 / (i2 + 1)); }
    std::array<double, 2> firstDerivatives(double, double i2) const {
        return {0.5 * Gs, -0.5 * Gs / ((i2 + 1) * (i2 + 1))};
    }
    std::array<double, 3> secondDerivatives(double, double i2) const {
        return {0, 0, Gs / ((i2 + 1) * (i2 + 1) * (i2 + 1))};
    }
    std::string constants() const override;
    static const Schema<NeoHookean>& schema();
};

}  // namespace corpuscle::membrane
