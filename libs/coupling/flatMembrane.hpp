// A flat membrane between two fluids on a lattice of particles: the conditions that the weights of its nodes
// (nodeFluidMap.hpp) must satisfy so that nodes move as in the exact flow.
//
// The flow is along the membrane and varies across it, as for the layers of particles of sph/viscousLayers.hpp. The
// velocity of a node is
//     u_m = sum_j w_j u_j + t H (du/dn)_m,   sum_j w_j phi(z_j) = v
// and a load on the node is spread by the same weights. v and t are chosen so that, in the mean over ten positions of
// the membrane between two layers,
//     self : a node with a load of 1 per area has the velocity -0.019; in the exact flow, which is linear on either
//            side, it has 0. Among disordered particles its velocity is higher by 0.019 than among layers (the twisted
//            sphere of tests/implicit/loadedSphere.cpp).
//     cross: a node stays at rest in the exact shear flow whose velocity is 0 at the membrane.
// With equal viscosities, t = 0. If the fluid inside is more than about six times as viscous as that outside, a loaded
// node moves too fast for any v and t; v is then that of the least self error, which is below 0.08. Lengths are in
// spacings, the viscosity outside is 1; weights are means over 36 positions along the membrane.
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
    Errors errors(int place, const NodeConditions& conditions) const;  // at one of the ten positions
    Errors meanErrors(const NodeConditions& conditions) const;
    NodeConditions conditions(double self = selfAmongLayers) const;

  private:
    using Vector = sph::ViscousLayers::Vector;
    struct Weights {
        Vector one, kink, derivative;  // weights with 1 for 1, phi or R d/dn and 0 for the rest of the basis
    };
    static Weights weights(double place, double radius);

    sph::ViscousLayers layers_;
    double ratio_, stepsOfSlope_;  // inside over outside viscosity; H/R
    double film_;                  // kappa of sph/viscousLayers.hpp
    std::vector<Weights> weights_;
};

}  // namespace corpuscle::coupling
