// Progress of the run of a case: the content of run.json, which the solver writes every few seconds, and whether a
// process is still running.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace corpuscle {

struct RunStatus {
    nlohmann::ordered_json record;  // run.json
    std::string state;              // running, killed, done, stopped, failed, dryRun
    std::string reason;

    bool isRunning() const { return state == "running"; }
    // Throws Failure(io) if no run of the case has begun.
    static RunStatus of(const std::filesystem::path& caseDir);
};

}  // namespace corpuscle
