// A program that runs in parallel with this one, with its output in a file.
//
// It has its own process group, so that Ctrl-C in a terminal does not reach it. It receives SIGTERM when this process
// ends in any way: a solver then writes a checkpoint and stops. Where the program is mpirun, stop() signals its ranks,
// since mpirun itself would wait and then end them.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace corpuscle::study {

// Environment variables of this process, read before MPI adds its own: a program that is started must not take itself
// for a part of this process.
class Environment {
  public:
    static Environment ofThisProcess();
    void set(const std::string& name, const std::string& value);  // unless the variable exists
    std::vector<char*> pointers();

  private:
    std::vector<std::string> entries_;  // NAME=value
};

class Process {
  public:
    // words: program and arguments; a program without '/' is looked up in PATH. Its output is appended to `log`. The
    // descriptors `kept` stay open in the program, so that a lock on one of them lasts as long as the program runs.
    // Throws Failure(io).
    Process(std::vector<std::string> words, const std::filesystem::path& log, Environment environment,
            const std::vector<int>& kept);
    Process(Process&& other) noexcept;
    Process& operator=(Process&& other) noexcept;
    ~Process();  // asks the program to stop, and does not wait for its end

    // The exit code, or 128 + the number of the signal that ended it; empty: it is still running.
    std::optional<int> poll();
    void stop();  // SIGTERM, to the ranks of mpirun, else to the whole group

  private:
    pid_t id_ = -1;
    bool isLauncher_ = false;  // mpirun
    std::optional<int> code_;
};

}  // namespace corpuscle::study
