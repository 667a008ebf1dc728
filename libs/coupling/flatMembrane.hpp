// A flat membrane between two fluids on a lattice of particles: what weights of its nodes have to be held to so that
// they move as in the exact flow (nodeFluidMap.hpp).
//
// The flow is along the membrane and varies across it: layers of particles as in sph/viscousLayers.hpp. A node's
// velocity is
//     u_m = sum_j w_j u_j + t H (du/dn)_m,   sum_j w_j phi(z_j) = v
// with a load spread by the same weights. v and t are those for which, in the mean over ten places of the membrane
// between two layers,
//     self : a node that is loaded with 1 per area moves by -0.019, where the exact flow has straight lines with 0
//            there: among disordered particles it moves by 0.019 more than among layers (the twisted sphere of
//            tests/implicit/loadedSphere.cpp)
//     cross: a node stays at rest in the exact shear flow whose velocity is 0 at the membrane
// Equal viscosities need no t. Where the fluid inside is more than about six times as viscous, a loaded node moves
// further whatever v and t are: there v is that of the least self error, which is below 0.08. Lengths in spacings,
// viscosity outside 1; mean over 36 places along the membrane.
#pragma once
#include "sph/viscousLayers.hpp"

namespace corpuscle::coupling {

struct NodeConditions {
    double kink = 0;   // v
    double slope = 0;  // t
};

class FlatMembrane {
  public:
    FlatMembrane(const sph::Kernel& kernel, double supportOverSpacing, double radiusInSpacings, double viscosityRatio);

    static constexpr double selfAmongLayers = -0.019;

    struct Errors {
        double cross = 0, self = 0;
    };
    Errors errors(int place, const NodeConditions& conditions) const;  // at one place
    Errors meanErrors(const NodeConditions& conditions) const;
    NodeConditions conditions(double self = selfAmongLayers) const;

  private:
    using Vector = sph::ViscousLayers::Vector;
    struct Weights {
        Vector one, kink, derivative;  // with 1 for this and 0 for the rest of the basis; the last in R d/dn
    };
    static Weights weights(double place, double radius);

    sph::ViscousLayers layers_;
    double ratio_, stepsOfSlope_;  // H/R
    double film_;                  // kappa
    std::vector<Weights> weights_;
};

}  // namespace corpuscle::coupling
