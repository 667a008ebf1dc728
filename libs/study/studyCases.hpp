// The cases of a study, and the dictionaries that each consists of.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "study/studySettings.hpp"

namespace corpuscle::study {

struct StudyCase {
    std::string name;                                         // of its folder
    std::vector<std::pair<std::string, std::string>> values;  // parameter and value, in the order of the study
    std::vector<Override> settings;                           // what differs from the template
    std::vector<std::string> programs = {};                   // that are run in it, in order
};

// In the order of the sampling. Names are the parameters with their values ("Ca0.02-spacing0.5um"), without those that
// follow another; where a sampling has none, or where they would be long or the same, numbers ("case007").
// `order`: of the parameters, as they stand in the file.
std::vector<StudyCase> casesOf(const StudySettings& study, const std::vector<std::string>& order);

// The template's dictionaries with the settings of one case: by path ("constant/flow.yaml"), the new text. Only files
// that differ. Throws CaseError or Failure(invalidCase), which names the entry.
std::map<std::string, std::string> dictionariesWith(const std::filesystem::path& templateCase,
                                                    const std::vector<Override>& settings);

// What a case needs to be run: cellPack, membraneMesh, particleFill and its solver, or membraneRelax. `dictionaries`:
// those that differ from the template's.
std::vector<std::string> programsOf(const std::filesystem::path& templateCase,
                                    const std::map<std::string, std::string>& dictionaries);

}  // namespace corpuscle::study
