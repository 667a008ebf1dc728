// Refuses a case that is too large for the machine before anything of its size is allocated: Linux would otherwise let
// the program run until it is killed.
#pragma once
#include "simulation/case.hpp"

namespace corpuscle::simulation {

// Collective. CaseError at system/numerics.yaml: spacing where estimateSize().memory (size.hpp), spread over the ranks,
// is more than the memory that a machine or its limits have left (core/machineMemory.hpp).
void requireMemory(const Communicator& communicator, const Case& input);

}  // namespace corpuscle::simulation
