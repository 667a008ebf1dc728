// Memory available to this process on this machine, and whether an estimate fits into it.
//
// Several limits hold at once; the smallest counts.
//
// limit                      | from                                                      | shared by
// free memory of the machine | MemAvailable in /proc/meminfo; swap is not counted        | ranks on the machine
// control group              | memory.max - memory.current + file cache (or those of     | ranks on the machine
//                            | version 1), of the group and of the groups above it       |
// ulimit -v, ulimit -d       | the soft limit minus what the process already uses        | not shared
#pragma once
#include <filesystem>
#include <limits>
#include <string>

#include "core/communicator.hpp"

namespace corpuscle {

struct MemoryLimit {
    double bytes = std::numeric_limits<double>::infinity();
    std::string name;  // "the memory limit of this process (ulimit -v)"
};

struct AvailableMemory {
    MemoryLimit shared;  // with the other processes of this machine
    MemoryLimit own;     // of this process alone
};

// Tests pass folders other than those of the running system.
AvailableMemory availableMemory(const std::filesystem::path& proc = "/proc",
                                const std::filesystem::path& cgroups = "/sys/fs/cgroup");

// Collective. `bytes` is the estimate for all ranks together, taken to be spread evenly. Returns an empty text when
// every machine has enough memory; otherwise a message, the same on all ranks: "126 GiB of memory is needed on host (2
// ranks), which has 3.1 GiB: free memory of the machine". Must be called before the estimated memory is allocated.
std::string memoryShortage(const Communicator& communicator, double bytes);

std::string formatBytes(double bytes);  // "412 MiB", "3.1 GiB"

}  // namespace corpuscle
