// Hooke's law of the plane for small strain, in Green's strain E = e/2, which makes it invariant under rotation (St
// Venant and Kirchhoff)
//     W = (Ks - Gs)/2 (tr E)^2 + Gs tr(E^2),     tr E = I1/2,   tr(E^2) = (I1^2 + 2 I1 - 2 I2)/4
// symbol | meaning       | unit
// Gs     | shear modulus | N/m
// Ks     | area modulus  | N/m
// Poisson's ratio (Ks - Gs)/(Ks + Gs). For strains of a few per cent: the sheet stiffens when stretched, and gives way
// when compressed below 1/sqrt(3) of its length.
#pragma once
#include "core/settings.hpp"
#include "membrane/invariantLaw.hpp"

namespace corpuscle::membrane {

struct LinearElastic final : InvariantLawOf<LinearElastic> {
    double Gs = 0, Ks = 0;  // N/m

    double W(double i1, double i2) const { return 0.125 * (Ks - Gs) * i1 * i1 + 0.25 * Gs * (i1 * i1 + 2 * (i1 - i2)); }
    std::array<double, 2> firstDerivatives(double i1, double) const {
        return {0.25 * (Ks - Gs) * i1 + 0.5 * Gs * (i1 + 1), -0.5 * Gs};
    }
    std::array<double, 3> secondDerivatives(double, double) const { return {0.25 * (Ks + Gs), 0, 0}; }
    std::string constants() const override;
    static const Schema<LinearElastic>& schema();
};

}  // namespace corpuscle::membrane
