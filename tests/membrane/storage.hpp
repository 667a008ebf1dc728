// Memory that this program has now allocated with operator new, which storage.cpp replaces. [bytes]
#pragma once
#include <cstddef>

namespace corpuscle::membrane::testing {

std::size_t storedBytes();

}  // namespace corpuscle::membrane::testing
