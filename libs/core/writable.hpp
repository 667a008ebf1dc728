// Whether a program will be able to write what it is about to compute, found at its start: files that cannot be made
// for want of permission, space, or a path that the system takes.
#pragma once
#include <filesystem>
#include <vector>

#include "core/communicator.hpp"

namespace corpuscle {

// Collective; the root makes and removes each file and the folders that are missing. Failure(io) on all ranks with a
// line for each that failed, by its folder. Names as long as the longest that will be written, temporary ones: a file
// that is there stays as it is.
void requireWritable(const Communicator& communicator, const std::vector<std::filesystem::path>& files);

}  // namespace corpuscle
