// Fuzz target, a checkpoint: it is opened, every dataset is read and compared with its checksum, and the time is read.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>

#include "core/error.hpp"
#include "io/checkpointAccess.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const int file = memfd_create("checkpoint", 0);
    if (write(file, data, size) != static_cast<ssize_t>(size)) std::abort();
    try {
        const corpuscle::io::CheckpointAccess checkpoint("/proc/self/fd/" + std::to_string(file));
        checkpoint.attribute<double>("time");
        checkpoint.verify();
    } catch (const corpuscle::Failure&) {
    }
    close(file);
    return 0;
}
