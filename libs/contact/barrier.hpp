// Barrier of contact (Li et al. 2020, here per area)
//     psi = k (1 - s)^2 ln(1/s),   s = g/R,   0 < g < R
//     psi' = k/R (1 - s) (2 ln s - (1 - s)/s)
//     psi'' = k/R^2 (-2 ln s + 4 (1 - s)/s + (1 - s)^2/s^2)  >= 0
// symbol | meaning                             | unit
// k      | strength: energy per area           | N/m
// R      | reach: gap at which contact begins  | m
// psi is C2 at the reach and infinite at g = 0. Under a pressure p the surfaces rest at the gap where -psi' = p: about
// g = k/p for s << 1; 0.53 R for p = k/R.
//
// Li et al. 2020, Incremental potential contact, ACM Trans. Graph. 39(4), 49.
#pragma once
#include "contact/contactLaw.hpp"

namespace corpuscle::contact {

struct Barrier : ContactLaw {
    double length = 0;    // R, m
    double strength = 0;  // k, N/m

    double reach() const override { return length; }
    Value at(double gap) const override;
    static const Schema<Barrier>& schema();
};

}  // namespace corpuscle::contact
