#include "core/buildInfo.hpp"

#include <mpi.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "core/commit.hpp"

namespace corpuscle {

namespace {

// Names and versions from a list, "Eigen 3.4.0,VTK 9.1.0", then MPI with the start of its own version text: "Open MPI
// v4.1.4".
std::vector<std::pair<std::string, std::string>> libraries(const std::string& list) {
    std::vector<std::pair<std::string, std::string>> all;
    std::istringstream entries(list);
    for (std::string entry; std::getline(entries, entry, ',');) {
        const std::size_t space = entry.rfind(' ');
        all.emplace_back(entry.substr(0, space), entry.substr(space + 1));
    }
    char words[MPI_MAX_LIBRARY_VERSION_STRING];
    int length = 0;
    MPI_Get_library_version(words, &length);
    const std::string mpi(words, static_cast<std::size_t>(length));
    all.emplace_back("MPI", mpi.substr(0, mpi.find_first_of(",\n")));
    return all;
}

}  // namespace

const BuildInfo& buildInfo() {
    static const BuildInfo info{CORPUSCLE_VERSION, CORPUSCLE_GIT,        CORPUSCLE_COMPILER,
                                CORPUSCLE_FLAGS,   CORPUSCLE_BUILD_TYPE, libraries(CORPUSCLE_LIBRARIES)};
    return info;
}

MachineInfo machineInfo() {
    MachineInfo machine;
    utsname names{};
    if (uname(&names) == 0) {
        machine.host = names.nodename;
        machine.system = std::string(names.sysname) + " " + names.release + " " + names.machine;
    }
    machine.cores = sysconf(_SC_NPROCESSORS_ONLN);
    std::ifstream cpuinfo("/proc/cpuinfo");
    for (std::string line; std::getline(cpuinfo, line);)
        if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos) {
            machine.processor = line.substr(line.find(": ") + 2);
            break;
        }
    return machine;
}

}  // namespace corpuscle
