// What to tell a user whose file could not be written: the file, the system's reason, the limit, and what to do.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/error.hpp"

namespace corpuscle {

// Failure(io): "cannot write results/fluid.pvd: No space left on device. ..." with advice that depends on the errno
// `reason`: free space on the disk, the limit on the size of files, permissions, or the longest path. 0: the system
// gave no reason.
Failure writeFailure(const std::filesystem::path& file, int reason);

// Tries to append to the file, which is created if it is missing. Returns the errno, or 0 on success; afterwards the
// file is as before. For libraries that do not report why they could not write. extent: smallest offset at which to
// write [B], for files that are written out of order.
int tryWriting(const std::filesystem::path& file, std::uintmax_t extent = 0);

// To be called once, at the start of a program. The signals of the limit on file sizes (SIGXFSZ) and of a closed pipe
// (SIGPIPE) would end a program without a message; ignored, they become errors of the write that caused them. Where
// standard output or error is closed, messages are discarded, and cannot end up in a file of the case that has been
// given the same descriptor number.
void prepareOutput();

}  // namespace corpuscle
