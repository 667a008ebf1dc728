#include "study/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

#include "core/error.hpp"

namespace corpuscle::study {

namespace {

// Child processes of a process, from /proc/PID/stat: "PID (name) state parent ...".
std::vector<pid_t> childrenOf(pid_t parent) {
    std::vector<pid_t> found;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator("/proc", ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        std::ifstream file(entry.path() / "stat");
        std::string text;
        std::getline(file, text);
        const std::size_t end = text.rfind(')');
        if (end == std::string::npos) continue;
        std::istringstream words(text.substr(end + 1));
        char state = 0;
        pid_t its = 0;
        if (words >> state >> its && its == parent) found.push_back(static_cast<pid_t>(std::stol(name)));
    }
    return found;
}

}  // namespace

Environment Environment::ofThisProcess() {
    Environment all;
    for (char** entry = environ; *entry; ++entry) all.entries_.emplace_back(*entry);
    return all;
}

void Environment::set(const std::string& name, const std::string& value) {
    const std::string start = name + "=";
    if (std::none_of(entries_.begin(), entries_.end(), [&](const auto& entry) { return entry.starts_with(start); }))
        entries_.push_back(start + value);
}

std::vector<char*> Environment::pointers() {
    std::vector<char*> all;
    all.reserve(entries_.size() + 1);
    for (std::string& entry : entries_) all.push_back(entry.data());
    all.push_back(nullptr);
    return all;
}

Process::Process(std::vector<std::string> words, const std::filesystem::path& log, Environment environment,
                 const std::vector<int>& kept) {
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    std::vector<char*> variables = environment.pointers();
    const int output = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (output < 0)
        throw Failure(ExitCode::io, fmt::format("{}: cannot be written: {}.", log.string(), std::strerror(errno)));
    isLauncher_ = std::filesystem::path(words[0]).filename() == "mpirun";
    const pid_t parent = getpid();
    id_ = fork();
    if (id_ == 0) {
        setpgid(0, 0);
        prctl(PR_SET_PDEATHSIG, SIGTERM);
        if (getppid() != parent) _exit(127);  // the parent has ended in the meantime
        for (const int signal : {SIGINT, SIGTERM, SIGPIPE}) std::signal(signal, SIG_DFL);
        const int input = open("/dev/null", O_RDONLY);
        dup2(input, 0);
        dup2(output, 1);
        dup2(output, 2);
        for (const int descriptor : kept) fcntl(descriptor, F_SETFD, 0);
        execvpe(arguments[0], arguments.data(), variables.data());
        dprintf(2, "%s cannot be started: %s\n", arguments[0], std::strerror(errno));
        _exit(127);
    }
    const int error = errno;
    close(output);
    if (id_ < 0) throw Failure(ExitCode::io, fmt::format("{} cannot be started: {}.", words[0], std::strerror(error)));
    setpgid(id_, id_);  // also set by the child: either may run first
}

Process::Process(Process&& other) noexcept
    : id_(std::exchange(other.id_, -1)), isLauncher_(other.isLauncher_), code_(other.code_) {}

Process& Process::operator=(Process&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(isLauncher_, other.isLauncher_);
    std::swap(code_, other.code_);
    return *this;
}

Process::~Process() {
    if (id_ > 0 && !code_) stop();
}

std::optional<int> Process::poll() {
    if (code_ || id_ < 0) return code_;
    int status = 0;
    const pid_t ended = waitpid(id_, &status, WNOHANG);
    if (ended == id_) code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (ended < 0 && errno != EINTR) code_ = 127;
    return code_;
}

void Process::stop() {
    if (id_ <= 0 || code_) return;
    const std::vector<pid_t> ranks = isLauncher_ ? childrenOf(id_) : std::vector<pid_t>{};
    for (const pid_t rank : ranks) kill(rank, SIGTERM);
    if (ranks.empty()) kill(-id_, SIGTERM);
}

}  // namespace corpuscle::study
