// Worm-like chain with a repulsive power (Marko and Siggia 1995; as a network: Fedosov, Caswell and Karniadakis,
// Comput. Methods Appl. Mech. Engrg 199:1937, 2010)
//     E = kBT lm/(4 p) (3 x^2 - 2 x^3)/(1 - x) + kp/((m-1) l^(m-1)) + constant,      x = l/lm
//     E' = kBT/p (1/(4 (1-x)^2) - 1/4 + x) - kp/l^m
// symbol | meaning                                                      | unit
// lm     | contour length l0/x0 (key x0)                                | m
// p      | persistence length (key persistenceLength)                   | m
// kBT    | thermal energy; 4.282e-21 J at 310.15 K                      | J
// kp     | constant of the repulsion: zero force at each bond's own l0  | N m^m
// m      | exponent of the repulsion                                    | -
// Gs     | sqrt(3)/4 E''(l0), on a hexagonal network; Ks = 2 Gs         | N/m
// Exactly one of Gs and p is given. With Gs all bonds have the same E''(l0), and p = kBT/a grows with 1/l0; with p the
// shorter bonds are the stiffer. Beyond the contour length: contourBond.hpp.
#pragma once
#include "core/settings.hpp"
#include "membrane/contourBond.hpp"

namespace corpuscle::membrane {

struct WormLikeChain {
    static double energy(double x) { return x * x * (3 - 2 * x) / (4 * (1 - x)); }
    static double force(double x) { return 0.25 / ((1 - x) * (1 - x)) - 0.25 + x; }
    static double slope(double x) { return 0.5 / ((1 - x) * (1 - x) * (1 - x)) + 1; }
};

struct WlcPow : ContourBondOf<WlcPow, WormLikeChain> {
    std::optional<double> persistenceLength;  // p, m
    double kBT = 0;                           // J

    void setStrength(ContourSpring<WormLikeChain>& spring) const { spring.strength = kBT / *persistenceLength; }
    std::string constants(double l0) const override;
    static const Schema<WlcPow>& schema();
};

}  // namespace corpuscle::membrane
