// What this program was built from and where it runs, for -version and run.json.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace corpuscle {

struct BuildInfo {
    std::string version;                                         // "0.2.0"
    std::string gitDescribe;                                     // "unknown" outside of a repository
    std::string compiler;                                        // "GNU 12.2.0"
    std::string flags, type;                                     // "-O3", "Release"
    std::vector<std::pair<std::string, std::string>> libraries;  // name, version
};
const BuildInfo& buildInfo();

struct MachineInfo {
    std::string host, processor, system;
    long cores = 0;
};
MachineInfo machineInfo();

}  // namespace corpuscle
