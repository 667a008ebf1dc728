// Keys of other programs that users write from habit, and their equivalents in Corpuscle.
#pragma once
#include "core/error.hpp"

namespace corpuscle::simulation {

// Throws all problems, like Problems::throwIfAny. If an unknown key is one of these, or belongs in another dictionary,
// the message says what to write.
void throwWithKeysInstead(const Problems& problems);

}  // namespace corpuscle::simulation
