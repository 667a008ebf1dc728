// sweep.json in each case of a study: where it comes from, and what has been done in it. Written whole after each
// program, so that a study that is killed goes on behind the last program that ended.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/studyCases.hpp"

namespace corpuscle::study {

struct CaseRecord {
    static constexpr const char* fileName = "sweep.json";

    struct Ended {
        std::string program = {};
        int code = 0;
        double seconds = 0;       // over all its starts
        std::string logEnd = {};  // of a program that failed: its last lines
    };

    std::string study = {};                                        // path of study.yaml from the case
    std::vector<std::pair<std::string, std::string>> values = {};  // of the parameters
    std::map<std::string, std::string> files = {};                 // other files of the template: their checksums
    std::vector<Ended> done = {};                                  // programs that ended with 0, in order
    std::optional<Ended> failed = {};
    double stoppedSeconds = 0;  // of a program that was stopped and goes on

    double seconds() const;
    void write(const std::filesystem::path& caseDir) const;
    // Throws Failure: invalidCase where it is damaged, io where it cannot be read.
    static std::optional<CaseRecord> read(const std::filesystem::path& caseDir);
};

// Checksums of the files that a run may depend on beside the dictionaries (core/caseFolder.hpp: dataFilesOf), by path.
std::map<std::string, std::string> otherFiles(const std::filesystem::path& caseDir, const std::string& excluded);

}  // namespace corpuscle::study
