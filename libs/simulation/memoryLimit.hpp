// Rejects a case that is too large for the memory of the machine, before large arrays are allocated: Linux would
// otherwise let the program run until it is killed.
#pragma once
#include "simulation/case.hpp"

namespace corpuscle::simulation {

// Throws CaseError at system/numerics.yaml: spacing if estimateSize().memory (size.hpp), distributed over the ranks,
// exceeds the memory that is left on a machine or within its limits (core/machineMemory.hpp). Collective.
void requireMemory(const Communicator& communicator, const Case& input);

}  // namespace corpuscle::simulation
