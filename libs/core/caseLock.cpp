#include "core/caseLock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

#include "core/buildInfo.hpp"
#include "core/runRecord.hpp"
#include "core/together.hpp"

namespace corpuscle {

namespace {

std::string bootId() {
    std::ifstream file("/proc/sys/kernel/random/boot_id");
    std::string text;
    std::getline(file, text);
    return text;
}

std::string inodeOf(int descriptor) {
    struct stat status {};
    if (fstat(descriptor, &status) != 0) return {};
    return fmt::format("{}:{}", status.st_dev, status.st_ino);
}

bool isStillAt(const std::filesystem::path& path, int descriptor) {
    struct stat there {
    }, here{};
    return stat(path.c_str(), &there) == 0 && fstat(descriptor, &here) == 0 && there.st_dev == here.st_dev &&
           there.st_ino == here.st_ino;
}

// Content of the file: "key: value", line by line.
struct Holder {
    std::string program = "another program", process, host, boot, since, inode;

    std::string text() const {
        return program + (process.empty() ? "" : ", process " + process) + (host.empty() ? "" : " on host " + host) +
               (since.empty() ? "" : ", since " + since);
    }
    bool isAlive() const {
        pid_t number = 0;
        std::from_chars(process.data(), process.data() + process.size(), number);
        return number > 0 && (kill(number, 0) == 0 || errno == EPERM);
    }
};

Holder readHolder(int descriptor) {
    std::string text;
    char block[512];
    lseek(descriptor, 0, SEEK_SET);
    for (ssize_t n = 0; text.size() < 4096 && (n = read(descriptor, block, sizeof block)) > 0;)
        text.append(block, static_cast<std::size_t>(n));
    Holder holder;
    const std::map<std::string, std::string*> fields{{"program", &holder.program}, {"process", &holder.process},
                                                     {"host", &holder.host},       {"boot", &holder.boot},
                                                     {"since", &holder.since},     {"file", &holder.inode}};
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (const std::size_t colon = line.find(": "); colon != std::string::npos)
            if (const auto field = fields.find(line.substr(0, colon)); field != fields.end())
                *field->second = line.substr(colon + 2);
    return holder;
}

std::string ownText(const std::string& program, int descriptor) {
    return fmt::format(
        "# A program of Corpuscle writes in this case. It removes this file when it ends.\n"
        "program: {}\nprocess: {}\nhost: {}\nboot: {}\nsince: {}\nfile: {}\n",
        program, getpid(), machineInfo().host, bootId(), timestamp(), inodeOf(descriptor));
}

// Signals that end the program before it has its own way to stop (StopControl). The path is kept where a signal handler
// may read it. While the file is being created or removed, such a signal is deferred, so that it can neither leave the
// file behind nor remove that of another program.
char pathToRemove[4096] = "";
constexpr int endings[] = {SIGINT, SIGTERM, SIGHUP};
volatile std::sig_atomic_t isWaiting = 0, waiting = 0;

void removeAndEnd(int number) {
    if (isWaiting != 0) {
        waiting = number;
        return;
    }
    if (pathToRemove[0] != '\0') unlink(pathToRemove);
    std::signal(number, SIG_DFL);
    std::raise(number);
}

void letSignalsWait() {
    isWaiting = 1;
    for (const int number : endings) {
        struct sigaction action {};
        if (sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_DFL) std::signal(number, removeAndEnd);
    }
}

void deliverSignals() {
    isWaiting = 0;
    if (const int number = waiting; number != 0) {
        waiting = 0;
        removeAndEnd(number);
    }
}

void armSignals(const std::filesystem::path& path) {
    std::error_code ignored;
    const std::string text = std::filesystem::absolute(path, ignored).string();
    if (text.size() < sizeof pathToRemove) std::strcpy(pathToRemove, text.c_str());
    deliverSignals();
}

void disarmSignals() {
    for (const int number : endings) {
        struct sigaction action {};
        if (sigaction(number, nullptr, &action) == 0 && action.sa_handler == removeAndEnd) std::signal(number, SIG_DFL);
    }
    deliverSignals();
}

[[noreturn]] void refuse(const std::filesystem::path& path, const Holder& holder) {
    throw Failure(
        ExitCode::io,
        fmt::format("{} is at work in this case ({}). Nothing was changed. Wait until it has ended, end it{}, "
                    "or work in a copy of the case",
                    holder.text(), path.string(),
                    holder.process.empty() ? "" : fmt::format(" (kill {})", holder.process)));
}

[[noreturn]] void refuseForeign(const std::filesystem::path& path, const Holder& holder) {
    throw Failure(
        ExitCode::io,
        fmt::format("{} says that {} is at work in this case, and from host {} it cannot be seen "
                    "whether it still is. Nothing was changed. If it has ended ('ssh {} ps -p "
                    "{}' shows nothing), remove {} and give the command again",
                    path.string(), holder.text(), machineInfo().host, holder.host, holder.process, path.string()));
}

// Why the file that was found is stale; empty: it is not left over, but new. Throws where its program may still be at
// work.
std::string whyStale(const std::filesystem::path& path, int descriptor, bool systemDecides) {
    const Holder holder = readHolder(descriptor);
    if (holder.process.empty()) return {};
    std::string why;
    if (!holder.inode.empty() && holder.inode != inodeOf(descriptor))
        why = "it was copied along with the case";
    else if (holder.boot == bootId())
        why = "that process has ended without removing it";
    else if (holder.host == machineInfo().host)
        why = "the host has been started again since then";
    else
        refuseForeign(path, holder);
    if (!systemDecides && holder.boot == bootId() && holder.isAlive()) refuse(path, holder);
    return fmt::format("{} of {} is stale ({}) and is taken over", path.string(), holder.text(), why);
}

int acquire(const std::filesystem::path& path, const std::string& program, Log& log) {
    constexpr int most = 20;  // times that another program may remove the file between two calls
    for (int attempt = 0; attempt < most; ++attempt) {
        const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor < 0)
            throw Failure(ExitCode::io,
                          fmt::format("cannot write {}, which says that this program works in the case: {}",
                                      path.string(), std::strerror(errno)));
        try {
            const bool isLocked = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
            if (!isLocked && errno == EWOULDBLOCK) refuse(path, readHolder(descriptor));
            if (!isStillAt(path, descriptor)) {
                close(descriptor);
                continue;
            }
            const std::string stale = whyStale(path, descriptor, isLocked);
            const std::string text = ownText(program, descriptor);
            if (ftruncate(descriptor, 0) != 0 ||
                pwrite(descriptor, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()))
                throw Failure(ExitCode::io, fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
            if (!stale.empty()) log.info("{}", stale);
            return descriptor;
        } catch (...) {
            close(descriptor);
            throw;
        }
    }
    throw Failure(ExitCode::io,
                  fmt::format("{} comes and goes: other programs start in this case all the time; give the "
                              "command again when they have ended",
                              path.string()));
}

}  // namespace

CaseLock::CaseLock(const std::filesystem::path& caseDir, const std::string& program, const Communicator& communicator,
                   Log& log)
    : path_(caseDir / fileName) {
    onRoot(communicator.handle(), [&] {
        if (!std::filesystem::is_directory(caseDir))
            throw Failure(ExitCode::io, fmt::format("the case directory {} is missing", caseDir.string()));
        letSignalsWait();
        try {
            descriptor_ = acquire(path_, program, log);
        } catch (...) {
            disarmSignals();
            throw;
        }
        armSignals(path_);
    });
}

CaseLock::~CaseLock() {
    if (descriptor_ < 0) return;
    isWaiting = 1;
    if (isStillAt(path_, descriptor_)) unlink(path_.c_str());
    pathToRemove[0] = '\0';
    close(descriptor_);
    disarmSignals();
}

void CaseLock::abandon() const { unlink(path_.c_str()); }

}  // namespace corpuscle
