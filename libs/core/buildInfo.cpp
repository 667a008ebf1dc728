#include "core/buildInfo.hpp"

#include <sys/utsname.h>
#include <unistd.h>

#include <fstream>

namespace corpuscle {

const BuildInfo& buildInfo() {
    static const BuildInfo info{CORPUSCLE_VERSION, CORPUSCLE_GIT, CORPUSCLE_COMPILER, CORPUSCLE_FLAGS,
                                CORPUSCLE_BUILD_TYPE};
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
