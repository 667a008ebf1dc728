// Runs Corpuscle's programs on many inputs, each in a fork of this process, so that neither the program nor MPI has to
// be started for each.
//
// Every line on standard input is one run,
//     PROGRAM SECONDS ARGUMENT...          membraneMesh 20 -case dir
// with words separated by tabs, and is answered by one line of JSON: the exit code or the signal, the run time in
// seconds, whether it exceeded SECONDS, and the end of the output. PROGRAM is one of those below, each with its own
// main(); `digest FILE` prints numbers that identify the content of a .vtp file. A run may use 4 GiB of address space
// (with AddressSanitizer: any).
#include <fcntl.h>
#include <fmt/format.h>
#include <mpi.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/startMpi.hpp"
#include "io/checksum.hpp"
#include "io/polyData.hpp"

int membraneMeshMain(int argc, char* argv[]);
int checkMeshMain(int argc, char* argv[]);
int checkCaseMain(int argc, char* argv[]);
int dmpFlowMain(int argc, char* argv[]);

namespace {

using corpuscle::io::PolyData;

std::uint64_t digestOf(const corpuscle::io::Arrays& arrays) {
    std::uint64_t sum = 0;
    const auto add = [&](const std::string& name, std::uint64_t part) {
        for (const char c : name) part = corpuscle::io::mix(part + static_cast<unsigned char>(c));
        sum += part;
    };
    for (const auto& [name, values] : arrays.scalars) add(name, corpuscle::io::checksum(std::span(values), 0));
    for (const auto& [name, values] : arrays.integers) add(name, corpuscle::io::checksum(std::span(values), 0));
    for (const auto& [name, values] : arrays.vectors)
        add(name,
            corpuscle::io::checksum(std::span(values.empty() ? nullptr : values[0].data(), 3 * values.size()), 0));
    return sum;
}

int digestMain(int, char* argv[]) {
    try {
        const PolyData data = corpuscle::io::readVtp(argv[1]);
        std::uint64_t sum = digestOf(data.point) + 3 * digestOf(data.cell);
        if (!data.points.empty())
            sum += corpuscle::io::checksum(std::span(data.points[0].data(), 3 * data.points.size()), 1);
        std::uint64_t corners = 0;
        for (const auto& t : data.triangles)
            for (const int n : t) corners = corpuscle::io::mix(corners + static_cast<std::uint64_t>(n));
        std::string texts;
        for (const auto& [name, value] : data.field) texts += fmt::format("{}={:a};", name, value);
        for (const auto& [name, value] : data.texts) texts += name + "=" + value + ";";
        for (const char c : texts) corners = corpuscle::io::mix(corners + static_cast<unsigned char>(c));
        fmt::print("{:x} {:x}\n", sum, corners);
        return 0;
    } catch (const corpuscle::Failure& failure) {
        fmt::print(stderr, "{}\n", failure.what());
        return static_cast<int>(failure.code());
    }
}

const std::map<std::string, int (*)(int, char**)> programs{{"membraneMesh", membraneMeshMain},
                                                           {"checkMesh", checkMeshMain},
                                                           {"checkCase", checkCaseMain},
                                                           {"dmpFlow", dmpFlowMain},
                                                           {"digest", digestMain}};

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find('\t', begin), line.size());
        words.push_back(line.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

[[noreturn]] void child(int (*program)(int, char**), std::vector<std::string> words, int said) {
    const int nothing = open("/dev/null", O_RDONLY);
    dup2(nothing, 0), dup2(said, 1), dup2(said, 2);
    const rlimit none{0, 0};
#ifndef __SANITIZE_ADDRESS__  // its shadow memory exceeds any limit
    const rlimit memory{rlim_t{4} << 30, rlim_t{4} << 30};
    setrlimit(RLIMIT_AS, &memory);
#endif
    setrlimit(RLIMIT_CORE, &none);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const int code = program(static_cast<int>(words.size()), arguments.data());
    std::cout.flush();
    std::fflush(nullptr);
    _exit(code);
}

// The last 4,000 bytes of the output.
std::string endOf(int said) {
    const off_t size = lseek(said, 0, SEEK_END), begin = std::max<off_t>(0, size - 4000);
    std::string text(static_cast<std::size_t>(size - begin), '\0');
    const ssize_t n = pread(said, text.data(), text.size(), begin);
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
    return text;
}

nlohmann::ordered_json runOne(const std::vector<std::string>& words) {
    const auto program = programs.find(words.at(0));
    if (program == programs.end()) return {{"error", "no program " + words[0]}};
    const double seconds = std::stod(words.at(1));
    std::vector<std::string> arguments{words[0]};
    arguments.insert(arguments.end(), words.begin() + 2, words.end());
    const int said = memfd_create("said", MFD_CLOEXEC);
    const auto begin = std::chrono::steady_clock::now();
    const pid_t pid = fork();
    if (pid == 0) child(program->second, arguments, said);
    pollfd waiting{static_cast<int>(syscall(SYS_pidfd_open, pid, 0)), POLLIN, 0};
    const bool over = poll(&waiting, 1, static_cast<int>(1000 * seconds)) == 0;
    if (over) kill(pid, SIGKILL);
    int status = 0;
    waitpid(pid, &status, 0);
    const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    nlohmann::ordered_json answer{{"code", WIFEXITED(status) ? WEXITSTATUS(status) : -1},
                                  {"signal", WIFSIGNALED(status) ? WTERMSIG(status) : 0},
                                  {"over", over},
                                  {"seconds", took},
                                  {"text", endOf(said)}};
    close(waiting.fd);
    close(said);
    return answer;
}

}  // namespace

int main(int argc, char* argv[]) {
    corpuscle::startMpi(argc, argv);
    for (std::string line; std::getline(std::cin, line);)
        std::cout << runOne(split(line)).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) << std::endl;
    MPI_Finalize();
    return 0;
}
