// Which scheme advances a case, and what automatic and absent keys of system/numerics.yaml stand for.
//
// key        | stands for
// coupling   | immersed; with rigid bodies dualIdentity, unless the integrator, named or chosen, is implicit
// integrator | the cheapest of those that can be used for the case (cost.hpp)
// operators  | corrected with immersed membranes (without rigid bodies) and with the implicit step, plain otherwise
// shifting   | absent: {coefficient: 1} with corrected operators, none otherwise
// step       | of `implicit`, absent: 0.05; where the flow itself changes with time, at most 1/40 of the time in which
//            | it changes
// support    | absent: that of the kernel; for Wendland's, 2.4 dx with corrected operators, 3.0 dx otherwise
#pragma once
#include "schemes/numericsSettings.hpp"

namespace corpuscle::schemes {

// The settings as written, settled for one integrator. For `automatic`, until it is chosen: as for velocityVerlet.
NumericsSettings settled(const NumericsSettings& written, const CaseFacts& facts, const std::string& integrator);

// Checks that the integrator suits coupling, operators and contents of the case: adds a problem for each that does not
// fit, and for each key that has no effect. With `automatic`, at least one integrator must be usable.
void check(const NumericsSettings& settled, const NumericsSettings& written, const CaseFacts& facts,
           Problems& problems);

// Why an integrator cannot be used for the case, in words; empty if it can.
std::string whyNot(const NumericsSettings& written, const CaseFacts& facts, const std::string& integrator);

}  // namespace corpuscle::schemes
