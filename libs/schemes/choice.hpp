// Which scheme steps a case, and what automatic and absent keys of system/numerics.yaml stand for.
//
// key        | stands for
// coupling   | immersed; beside rigid bodies dualIdentity unless the integrator, named or chosen, is implicit
// integrator | the cheapest of those that can do the case (cost.hpp)
// operators  | corrected with immersed membranes (not beside rigid bodies) and with the implicit step, plain otherwise
// shifting   | absent: {coefficient: 1} with corrected operators, none otherwise
// step       | of `implicit`, absent: 0.05; where the flow changes by itself at most a fortieth of the time in which it
//            | does
// support    | absent: of the kernel; Wendland's 2.4 dx with corrected operators, 3.0 dx otherwise
#pragma once
#include "schemes/numericsSettings.hpp"

namespace corpuscle::schemes {

// As written, for one integrator. For `automatic`, until it is chosen: as for velocityVerlet.
NumericsSettings settled(const NumericsSettings& written, const CaseFacts& facts, const std::string& integrator);

// Which integrator goes with which coupling, operators and contents: adds a problem for each thing that does not, and
// for each key that means nothing. With `automatic` some integrator has to be left.
void check(const NumericsSettings& settled, const NumericsSettings& written, const CaseFacts& facts,
           Problems& problems);

// Why the case cannot be stepped with an integrator, in words; empty where it can.
std::string whyNot(const NumericsSettings& written, const CaseFacts& facts, const std::string& integrator);

}  // namespace corpuscle::schemes
