#include "core/machineMemory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>

#include "core/buildInfo.hpp"
#include "core/together.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

// The number that a file holds; none where it is missing or says "max".
std::optional<double> number(const fs::path& file) {
    std::ifstream stream(file);
    double value = 0;
    if (stream >> value) return value;
    return std::nullopt;
}

// The number after `word` at the start of a line.
std::optional<double> entry(const fs::path& file, const std::string& word) {
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        std::istringstream words(line);
        std::string first;
        double value = 0;
        if (words >> first >> value && first == word) return value;
    }
    return std::nullopt;
}

void keepSmaller(MemoryLimit& limit, double bytes, const char* name) {
    if (bytes < limit.bytes) limit = {std::max(bytes, 0.0), name};
}

// Names of the same quantities in the two versions of control groups.
struct Names {
    const char *limit, *usage, *inactiveFile, *activeFile;
};
constexpr Names version2{"memory.max", "memory.current", "inactive_file", "active_file"};
constexpr Names version1{"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file", "total_active_file"};

// Limits of the group and of all groups above it. A container sees only its own part of the tree, so missing folders
// are skipped.
void keepControlGroup(MemoryLimit& limit, const fs::path& root, fs::path group, const Names& names) {
    for (group = group.relative_path();; group = group.parent_path()) {
        const fs::path folder = group.empty() ? root : root / group;
        const auto most = number(folder / names.limit), used = number(folder / names.usage);
        if (most && used) {
            const double cache = entry(folder / "memory.stat", names.inactiveFile).value_or(0) +
                                 entry(folder / "memory.stat", names.activeFile).value_or(0);
            keepSmaller(limit, *most - std::max(0.0, *used - cache),
                        "the memory limit of the control group (container or batch job)");
        }
        if (group.empty()) return;
    }
}

void keepControlGroups(MemoryLimit& limit, const fs::path& proc, const fs::path& cgroups) {
    std::ifstream groups(proc / "self" / "cgroup");
    for (std::string line; std::getline(groups, line);) {  // "0::/path" or "4:cpu,memory:/path"
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
        const fs::path group = line.substr(second + 1);
        if (controllers == ",,")
            keepControlGroup(limit, cgroups, group, version2);
        else if (controllers.find(",memory,") != std::string::npos)
            keepControlGroup(limit, cgroups / "memory", group, version1);
    }
}

std::optional<double> softLimit(decltype(RLIMIT_AS) resource) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
    return static_cast<double>(limit.rlim_cur);
}

}  // namespace

AvailableMemory availableMemory(const fs::path& proc, const fs::path& cgroups) {
    constexpr double kibibyte = 1024;
    AvailableMemory memory;
    if (const auto free = entry(proc / "meminfo", "MemAvailable:"))
        keepSmaller(memory.shared, *free * kibibyte, "the free memory of the machine");
    keepControlGroups(memory.shared, proc, cgroups);
    const fs::path status = proc / "self" / "status";
    if (const auto limit = softLimit(RLIMIT_AS))
        keepSmaller(memory.own, *limit - entry(status, "VmSize:").value_or(0) * kibibyte,
                    "the memory limit of the process (ulimit -v)");
    if (const auto limit = softLimit(RLIMIT_DATA))
        keepSmaller(memory.own, *limit - entry(status, "VmData:").value_or(0) * kibibyte,
                    "the memory limit of the process (ulimit -d)");
    return memory;
}

std::string memoryShortage(const Communicator& communicator, double bytes) {
    MPI_Comm machine = MPI_COMM_NULL;
    MPI_Comm_split_type(communicator.handle(), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    int ranksHere = 1;
    MPI_Comm_size(machine, &ranksHere);
    MPI_Comm_free(&machine);

    const AvailableMemory memory = availableMemory();
    const double each = bytes / communicator.size(), here = each * ranksHere;
    std::string text;
    if (here > memory.shared.bytes)
        text = fmt::format("{} of memory is needed on {} ({} rank{}), which has {}: {}", formatBytes(here),
                           machineInfo().host, ranksHere, ranksHere > 1 ? "s" : "", formatBytes(memory.shared.bytes),
                           memory.shared.name);
    else if (each > memory.own.bytes)
        text = fmt::format("{} of memory is needed by each rank, which has {} on {}: {}", formatBytes(each),
                           formatBytes(memory.own.bytes), machineInfo().host, memory.own.name);
    return firstFailed(communicator.handle(), !text.empty(), text) < 0 ? "" : text;
}

std::string formatBytes(double bytes) {
    constexpr const char* units[] = {"B", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB", "ZiB", "YiB"};
    std::size_t unit = 0;
    for (; bytes >= 1000 && unit + 1 < std::size(units); ++unit) bytes /= 1024;
    return fmt::format(fmt::runtime(bytes < 10 && unit > 0 ? "{:.1f} {}" : "{:.0f} {}"), bytes, units[unit]);
}

}  // namespace corpuscle
