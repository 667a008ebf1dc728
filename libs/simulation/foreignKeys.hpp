// Keys of other programs that people write from habit, and what does their work here.
#pragma once
#include "core/error.hpp"

namespace corpuscle::simulation {

// Throws all problems, as Problems::throwIfAny; those about an unknown key that is one of these say what to write.
void throwWithKeysInstead(const Problems& problems);

}  // namespace corpuscle::simulation
