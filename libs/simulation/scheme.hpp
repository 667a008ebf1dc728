// What `automatic` and absent keys of system/numerics.yaml stand for.
//
// key        | stands for
// coupling   | immersed; dualIdentity beside rigid bodies, unless the integrator is named implicit
// integrator | the cheapest of those that can do the case (cost.hpp)
// operators  | corrected with immersed membranes (not beside rigid bodies) and with the implicit step, plain otherwise
// shifting   | absent: {coefficient: 1} with corrected operators, none otherwise
#pragma once
#include "simulation/case.hpp"

namespace corpuscle::simulation {

// As written, for one integrator.
NumericsSettings schemeOf(const Case& c, const std::string& integrator);

}  // namespace corpuscle::simulation
