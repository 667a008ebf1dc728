// The cases of a study, and the dictionaries of each.
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
    std::vector<std::string> programs = {};                   // to be run in the case, in order
};

// Cases in the order of the sampling. A name consists of the parameters with their values ("Ca0.02-spacing0.5um"),
// without parameters that follow another. Cases are numbered instead ("case007") where the sampling does not name them,
// or where names would be too long or not unique. `order`: the parameters in the order of the file.
std::vector<StudyCase> casesOf(const StudySettings& study, const std::vector<std::string>& order);

// The template's dictionaries with the settings of one case: the new text by path ("constant/flow.yaml"), only of files
// that differ. Throws CaseError or Failure(invalidCase), which names the entry.
std::map<std::string, std::string> dictionariesWith(const std::filesystem::path& templateCase,
                                                    const std::vector<Override>& settings);

// Programs that a case needs: cellPack, membraneMesh, particleFill and its solver, or membraneRelax. `dictionaries`:
// those that differ from the template's.
std::vector<std::string> programsOf(const std::filesystem::path& templateCase,
                                    const std::map<std::string, std::string>& dictionaries);

}  // namespace corpuscle::study
