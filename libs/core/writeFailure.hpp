// What to tell a user whose file could not be written: the file, the system's reason, the limit, and the way out.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/error.hpp"

namespace corpuscle {

// Failure(io): "cannot write results/fluid.pvd: No space left on device. ..." with the cure that belongs to the errno
// `reason`: how much is free on its disk, the limit on the size of files, permissions, or the longest path. 0: a reason
// that the system did not give.
Failure writeFailure(const std::filesystem::path& file, int reason);

// The errno of adding to the file, which it makes if it is missing, or 0 when that works; the file is as before
// afterwards. For libraries that write and do not say why they could not.
// extent: where it adds at the earliest [B], for files that are written out of order.
int tryWriting(const std::filesystem::path& file, std::uintmax_t extent = 0);

// Once, at the start of a program. The signals of a limit on file sizes (SIGXFSZ) and of a closed pipe (SIGPIPE) end a
// program without a word; ignored, they become errors of the write that caused them. Where standard output or error is
// closed, what is said goes nowhere, and not into a file of the case that has been given its number.
void prepareOutput();

}  // namespace corpuscle
