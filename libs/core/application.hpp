// The frame of every program: options, MPI, log, exit codes.
//
//     int main(int argc, char* argv[]) {
//         Application app("dmpFlow", "Red blood cells in flow.", argc, argv, {.options = solverOptions()});
//         return app.run([&] {
//             Problems problems;
//             const Node control = app.dictionary("system/control.yaml", problems);
//             ...
//             return ExitCode::done;
//         });
//     }
//
// run() handles -help, -version and a wrong command line, and then does not call the body. An exception from the body
// is printed once and determines the exit code; when one rank fails while others wait for it, all ranks are ended with
// that code. A closed pipe (dmpFlow | head) does not end a program: what the terminal misses is still in the log file.
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/caseLock.hpp"
#include "core/communicator.hpp"
#include "core/dictionary.hpp"
#include "core/log.hpp"
#include "core/runRecord.hpp"

namespace corpuscle {

struct Option {
    std::string name;      // "steps", written -steps
    std::string argument;  // "N"; empty: a switch
    std::string text;      // one sentence
};

// -dry-run, -steps N, -restart TIME.
std::vector<Option> solverOptions();

struct Usage {
    std::vector<Option> options = {};       // in addition to -case -set -quiet -json -help -version
    std::vector<Option> arguments = {};     // positional, in order; name "FROM"; all are required ...
    std::size_t optionalArguments = 0;      // ... except this number of them, the last ones
    std::vector<std::string> samples = {};  // sample runs, "dmpFlow -case rbcShear/Ca0.02 -steps 10"
};

class Application {
  public:
    Application(std::string name, std::string text, int argc, char** argv, Usage usage = {});
    ~Application();
    Application(const Application&) = delete;
    Application& operator=(const Application&) = delete;

    const std::string& name() const { return name_; }
    const Communicator& communicator() const { return *communicator_; }
    Log& log() { return *log_; }
    // With -json, standard output carries one JSON value only, which the application prints.
    bool json() const { return has("json"); }

    std::filesystem::path caseDirectory() const;
    std::filesystem::path path(const std::string& inCase) const { return caseDirectory() / inCase; }

    bool has(const std::string& option) const { return given_.contains(option); }
    std::optional<std::string> value(const std::string& option) const;
    // Failure(usage) when the value is not a whole number of at least `low`.
    std::optional<long> integer(const std::string& option, long low = 0) const;
    const std::vector<std::string>& arguments() const { return arguments_; }
    std::string commandLine() const { return commandLine_; }
    const std::vector<Override>& overrides() const { return overrides_; }

    // Collective. A dictionary of the case, read by the root, with the -set changes applied.
    Node dictionary(const std::string& inCase, Problems& problems) const;
    // Whether the case has this file. Collective.
    bool hasDictionary(const std::string& inCase) const;

    // Prints name, version and command line on the terminal; the log file gets them when it is opened.
    void announce();
    // Locks the case until the program ends: no other program can write in it (caseLock.hpp). To be called before the
    // program changes any file. Collective.
    void lockCase();
    // Opens log.<application> in the case directory: a new file or, for a run that continues an earlier one, the old
    // file, which is continued after a line that says so. To be called only when it is certain that the program will do
    // what it was asked for, since a rejected command must not change any file.
    enum class LogStart { anew, continued };
    void openLog(LogStart start = LogStart::anew);

    // Sets the record that also receives an error that ends the program, besides the terminal and the log.
    void keepRecord(std::shared_ptr<RunRecord> record) { record_ = std::move(record); }

    int run(const std::function<ExitCode()>& body);

  private:
    void parse(int argc, char** argv);
    std::vector<Option> allOptions() const;
    std::string helpText() const;
    void checkOverrides() const;
    void reportFailure(ExitCode code, const std::exception& error, bool named);
    void requireOutput() const;
    int outcome(const std::function<ExitCode()>& body);
    int endTogether(ExitCode code, const std::exception* error);

    std::string name_, text_, commandLine_;
    Usage usage_;
    std::map<std::string, std::string> given_;
    std::vector<std::string> arguments_;
    std::vector<Override> overrides_;
    std::optional<Failure> usageFailure_;
    bool ownsMpi_ = false;
    MPI_Comm meeting_ = MPI_COMM_NULL;  // used only in endTogether(), so that no other collective call can match it
    std::optional<Communicator> communicator_;
    std::optional<Log> log_;
    std::optional<CaseLock> lock_;
    std::shared_ptr<RunRecord> record_;
};

}  // namespace corpuscle
