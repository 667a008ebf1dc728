// The energy that the solver's tolerance refers to: that of the disturbance w of the affine flow by the system's own
// form,
//     w.A w = w.(b - A affine),     where A of an affine flow is c1 M and what resists it in the membranes.
#pragma once
#include "implicit/system.hpp"

namespace corpuscle::implicit {

// Of the velocity v found with this divergence of each own particle [W]. Collective.
template <class Real>
double disturbanceOf(System<Real>& system, const typename System<Real>::Field& v,
                     const std::vector<double>& divergence);
// Below which no flow counts as disturbed [W].
double leastDisturbance(const coupling::Scene& scene);

extern template double disturbanceOf(System<double>&, const System<double>::Field&, const std::vector<double>&);
extern template double disturbanceOf(System<float>&, const System<float>::Field&, const std::vector<double>&);

}  // namespace corpuscle::implicit
