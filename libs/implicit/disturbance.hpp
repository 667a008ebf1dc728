// The energy to which the tolerance of the solver refers: that of the disturbance w, the velocity less the affine flow,
// in the energy norm of the system itself,
//     w.A w = w.(b - A affine),     where A of an affine flow is c1 M and the resistance of the membranes to it.
#pragma once
#include "implicit/system.hpp"

namespace corpuscle::implicit {

// Energy of the disturbance in the computed velocity v [W]; divergence: that of v at each own particle. Collective.
template <class Real>
double disturbanceOf(System<Real>& system, const typename System<Real>::Field& v,
                     const std::vector<double>& divergence);
// Energy below which no flow counts as disturbed [W].
double leastDisturbance(const coupling::Scene& scene);

extern template double disturbanceOf(System<double>&, const System<double>::Field&, const std::vector<double>&);
extern template double disturbanceOf(System<float>&, const System<float>::Field&, const std::vector<double>&);

}  // namespace corpuscle::implicit
