// Finitely extensible spring with a repulsive power (Fedosov, Caswell and Karniadakis, Comput. Methods Appl. Mech.
// Engrg 199:1937, 2010)
//     E = -ks/2 lm^2 ln(1 - x^2) + kp/((m-1) l^(m-1)) + constant,      x = l/lm
//     E' = ks l/(1 - x^2) - kp/l^m
// symbol | meaning                                                      | unit
// lm     | contour length l0/x0 (key x0)                                | m
// ks     | spring constant at small extension                           | N/m
// kp     | constant of the repulsion: zero force at each bond's own l0  | N m^m
// m      | exponent of the repulsion                                    | -
// Gs     | sqrt(3)/4 E''(l0), on a hexagonal network; Ks = 2 Gs         | N/m
// Exactly one of Gs and ks is given; either way all bonds have the same E''(l0). Beyond the contour length:
// contourBond.hpp.
#pragma once
#include "core/settings.hpp"
#include "membrane/contourBond.hpp"

namespace corpuscle::membrane {

struct FiniteExtension {
    static double energy(double x) { return -0.5 * std::log1p(-x * x); }
    static double force(double x) { return x / (1 - x * x); }
    static double slope(double x) { return (1 + x * x) / ((1 - x * x) * (1 - x * x)); }
};

struct FenePow : ContourBondOf<FenePow, FiniteExtension> {
    std::optional<double> ks;  // N/m

    void setStrength(ContourSpring<FiniteExtension>& spring) const { spring.strengthPerLength = *ks / x0; }
    std::string constants(double l0) const override;
    static const Schema<FenePow>& schema();
};

}  // namespace corpuscle::membrane
