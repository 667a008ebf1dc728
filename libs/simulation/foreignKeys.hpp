// Keys of other programs that people write from habit, and what does their work here.
#pragma once
#include "core/error.hpp"

namespace corpuscle::simulation {

// Of a dictionary ("system/control.yaml"); empty: none is known.
std::string insteadOf(const std::string& file, const std::string& key);

// Throws all problems, as Problems::throwIfAny; those about an unknown key that is one of these say what to write.
void throwWithKeysInstead(const Problems& problems);

}  // namespace corpuscle::simulation
