#include "runStatus.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>

#include "core/buildInfo.hpp"
#include "core/error.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

// The host of the process that writes in a case, as stated in case.lock.
std::string hostOf(const fs::path& lock) {
    std::ifstream stream(lock);
    for (std::string line; std::getline(stream, line);)
        if (line.starts_with("host: ")) return line.substr(6);
    return {};
}

// The operating system releases the lock when a process ends. For a process on another host this cannot be seen; there
// the existence of the file is taken as proof.
bool isAtWork(const fs::path& caseDir) {
    const fs::path lock = caseDir / "case.lock";
    const int file = open(lock.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return false;
    const std::string host = hostOf(lock);
    const bool isFree = flock(file, LOCK_SH | LOCK_NB) == 0;
    close(file);
    return !isFree || (!host.empty() && host != machineInfo().host);
}

}  // namespace

RunStatus RunStatus::of(const fs::path& caseDir) {
    const fs::path file = caseDir / "run.json";
    std::ifstream stream(file);
    if (!stream)
        throw Failure(ExitCode::io,
                      fmt::format("{} is missing: no solver has run in this case (is -case right?).", file.string()));
    RunStatus status;
    status.record = nlohmann::ordered_json::parse(stream, nullptr, false);
    if (!status.record.is_object())
        throw Failure(ExitCode::io,
                      fmt::format("{}: cannot be read as JSON; it is written anew by the next run.", file.string()));
    status.state = status.record.value("status", "unknown");
    if (status.record.contains("reason") && status.record["reason"].is_string())
        status.reason = status.record["reason"].get<std::string>();
    if (status.isRunning() && !isAtWork(caseDir)) {
        status.state = "killed";
        status.reason = "no process is at work in this case; the same command goes on from the last checkpoint";
    }
    return status;
}

}  // namespace corpuscle
