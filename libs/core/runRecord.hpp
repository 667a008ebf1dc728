// run.json: what was run, on what machine, from which settings, and how it ended. The file is rewritten as a whole at
// every change that matters, so that a killed run leaves a record with the status "running".
//
//     {"application", "status": "running|done|failed|stopped|dryRun", "reason", "start", "end", "wallClock_s",
//      "version", "versions" of the libraries, "build": {...}, "machine": {...}, "ranks", and the sections that the
//      application adds: "parameters", "groups", "performance", ...}
#pragma once
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/communicator.hpp"
#include "core/dictionary.hpp"
#include "core/error.hpp"

namespace corpuscle {

class RunRecord {
  public:
    using Value = std::variant<bool, long, double, std::string, std::vector<double>, std::vector<std::string>>;

    // Ranks other than the root keep nothing and write nothing.
    RunRecord(std::filesystem::path file, const std::string& application, const Communicator& communicator);
    ~RunRecord();
    RunRecord(const RunRecord&) = delete;
    RunRecord& operator=(const RunRecord&) = delete;

    // An empty section is the top level. Numbers that are not finite become null.
    template <class T>
    void set(const std::string& section, const std::string& key, const T& value) {
        if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>)
            put(section, key, static_cast<long>(value));
        else
            put(section, key, value);
    }
    void setJson(const std::string& section, const std::string& key, const nlohmann::ordered_json& value);

    void write() const;
    void print() const;  // on standard output
    // Fills in status, reason and end, and writes.
    void finish(ExitCode code, const std::string& reason);
    // The same for a run that ends with an error. Any rank that knows of the error may call it, since the root may be
    // waiting for the others. Never throws; writes even on a full disk.
    void fail(ExitCode code, const std::string& reason) noexcept;
    bool finished() const { return finished_; }

  private:
    std::string text() const;
    void close(ExitCode code, const std::string& reason);
    void put(const std::string& section, const std::string& key, const Value& value);

    std::filesystem::path file_;
    bool isRoot_;
    std::chrono::steady_clock::time_point start_;
    std::unique_ptr<nlohmann::ordered_json> record_;
    bool finished_ = false;
};

// used.yaml: every dictionary of the run with its effective settings, defaults and -set included, in SI values with
// units; one table for each file, which can be copied out as that file. Only the root writes.
void writeUsed(const std::filesystem::path& file, const std::vector<Node::Entry>& dictionaries,
               const Communicator& communicator);

std::string timestamp();  // now, "2026-01-31T12:00:00Z"

}  // namespace corpuscle
