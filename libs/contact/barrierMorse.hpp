// Barrier of contact with an attraction, by which red cells form rouleaux: the barrier of barrier.hpp plus a Morse
// potential that a factor C reduces smoothly to 0
//     psi = psi_barrier(g) + D (e^2 - 2 e) C(g),   e = exp(-(g - g0)/l)
//     C = 1 for g <= g0,   1 - z^3 (10 - 15 z + 6 z^2) for g0 < g < Rc, z = (g - g0)/(Rc - g0),   0 from Rc on
// symbol | meaning                                                   | unit
// D      | depth: energy per area that separates resting surfaces    | J/m^2
// g0     | rest gap, not below the reach of the barrier              | m
// l      | decay length of the attraction (1/b of Morse's potential) | m
// Rc     | cutoff: gap from which on psi is 0                        | m
// psi has its minimum at g0, psi(g0) = -D, with psi''(g0) = 2 D/l^2, since C has neither slope nor curvature there. The
// largest attraction is about D/(2 l) times C, at g = g0 + l ln 2.
//
// A Morse potential between red cells: Liu and Liu 2006, Rheology of red blood cell aggregation by computer simulation,
// J. Comput. Phys. 220, 139.
#pragma once
#include "contact/barrier.hpp"

namespace corpuscle::contact {

struct BarrierMorse : Barrier {
    double depth = 0;   // D, J/m^2
    double rest = 0;    // g0, m
    double decay = 0;   // l, m
    double cutoff = 0;  // Rc, m

    double reach() const override { return cutoff; }
    Value at(double gap) const override;
    std::optional<double> restGap() const override { return rest; }
    static const Schema<BarrierMorse>& schema();
};

}  // namespace corpuscle::contact
