// sweep.json in each case of a study: the origin of the case, and which programs have run in it. The whole file is
// written again after each program, so that a study that was killed continues after the last program that ended.
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
        double seconds = 0;       // summed over all its starts
        std::string logEnd = {};  // last lines of the log of a program that failed
    };

    std::string study = {};                                        // path of study.yaml, relative to the case
    std::vector<std::pair<std::string, std::string>> values = {};  // of the parameters
    std::map<std::string, std::string> files = {};                 // checksums of the template's other files, by path
    std::vector<Ended> done = {};                                  // programs that ended with 0, in order
    std::optional<Ended> failed = {};
    double stoppedSeconds = 0;  // of a program that was stopped and will continue

    double seconds() const;
    void write(const std::filesystem::path& caseDir) const;
    // Empty if the file does not exist. Throws Failure: invalidCase if it is damaged, io if it cannot be read.
    static std::optional<CaseRecord> read(const std::filesystem::path& caseDir);
};

// Checksums, by path, of the files that a run may depend on besides the dictionaries (core/caseFolder.hpp:
// dataFilesOf).
std::map<std::string, std::string> otherFiles(const std::filesystem::path& caseDir, const std::string& excluded);

}  // namespace corpuscle::study
