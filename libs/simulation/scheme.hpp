// What `automatic` and absent keys of system/numerics.yaml and system/mesh.yaml stand for.
//
// key        | stands for
// coupling   | immersed; beside rigid bodies dualIdentity unless the integrator, named or chosen, is implicit
// integrator | the cheapest of those that can do the case (cost.hpp)
// operators  | corrected with immersed membranes (not beside rigid bodies) and with the implicit step, plain otherwise
// shifting   | absent: {coefficient: 1} with corrected operators, none otherwise
// step       | of `implicit`, absent: 0.05; where the flow changes by itself at most a fortieth of the time in which it does
// support    | absent: of the kernel; Wendland's 2.4 dx with corrected operators, 3.0 dx otherwise
// jitter     | absent: 0.1 with immersed membranes and in flows of three dimensions, 0 otherwise. Where the flow draws a perfect lattice out its
//            | planes part: all neighbours of a particle come to lie in one plane, and shifting, which follows gradients, does not see it because
//            | every particle has its mirror image
#pragma once
#include "simulation/case.hpp"

namespace corpuscle::simulation {

// As written, for one integrator.
NumericsSettings schemeOf(const Case& c, const std::string& integrator);
double jitterOf(const Case& c);  // once the scheme is known
// Of the implicit step where the flow changes by itself [s]; 0: no limit.
double longestStep(const sph::FlowState& flow);

}  // namespace corpuscle::simulation
