// Checks at the start of a program whether it will be able to write what it is about to compute: a file may be
// impossible to create for lack of permission or space, or because the system does not accept its path.
#pragma once
#include <filesystem>
#include <vector>

#include "core/communicator.hpp"

namespace corpuscle {

// Collective; the root creates and removes each file and the missing folders. Failure(io) on all ranks with a line for
// each file that failed. Pass temporary names, as long as the longest that will be written; an existing file stays as
// it is.
void requireWritable(const Communicator& communicator, const std::vector<std::filesystem::path>& files);

}  // namespace corpuscle
