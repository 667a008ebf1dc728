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

// Of the process that writes in a case, as case.lock names it.
std::string hostOf(const fs::path& lock) {
    std::ifstream stream(lock);
    for (std::string line; std::getline(stream, line);)
        if (line.starts_with("host: ")) return line.substr(6);
    return {};
}

// The system lets go of the lock when a process ends. Of another host nothing can be known: its file is believed.
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
