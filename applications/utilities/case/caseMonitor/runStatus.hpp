// How far the run of a case is: run.json as the solver writes it every few seconds, and whether a process is at work.
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
    // Throws Failure(io) where no run has begun.
    static RunStatus of(const std::filesystem::path& caseDir);
};

}  // namespace corpuscle
