// A program that runs beside this one, with its output in a file.
//
// It has a process group of its own, so that a terminal's Ctrl-C does not reach it, and is asked to stop (SIGTERM) when
// this process ends in whatever way: a solver then writes a checkpoint and stops. Of mpirun the ranks are asked: by
// itself it would wait, and then end them.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace corpuscle::study {

// Of this process, before MPI adds its own: a program that is started must not take itself for a part of this one.
class Environment {
  public:
    static Environment ofThisProcess();
    void set(const std::string& name, const std::string& value);  // unless it is there
    std::vector<char*> pointers();

  private:
    std::vector<std::string> entries_;  // NAME=value
};

class Process {
  public:
    // words: program and arguments; a program without '/' is looked for along PATH. Its output is added to `log`. The
    // descriptors `kept` stay open in it, so that a lock on one of them lasts as long as it runs. Throws Failure(io).
    Process(std::vector<std::string> words, const std::filesystem::path& log, Environment environment,
            const std::vector<int>& kept);
    Process(Process&& other) noexcept;
    Process& operator=(Process&& other) noexcept;
    ~Process();  // asks it to stop, and does not wait

    // The exit code, or 128 + the number of the signal that ended it; empty: it is still running.
    std::optional<int> poll();
    void stop();  // SIGTERM, to the ranks of mpirun, else to the whole group

  private:
    pid_t id_ = -1;
    bool isLauncher_ = false;  // mpirun
    std::optional<int> code_;
};

}  // namespace corpuscle::study
