// Checks which files a case has in system/ and constant/. A dictionary that no program reads is an error: otherwise a
// misspelt observers.yaml would be ignored silently.
//
// Ignored are hidden files, backups of editors (x~, #x#, .bak, .orig, .swp, ...), README and similar files, folders,
// and files of other kinds (surfaces, pictures, tables), which are read only if a dictionary names them.
#pragma once
#include <set>
#include <string>
#include <vector>

#include "core/application.hpp"

namespace corpuscle::simulation {

// All dictionaries that programs read: "system/control.yaml", ...
const std::vector<std::string>& dictionaryFiles();

// Adds a problem for each file that looks like a dictionary but is none. Returns the missing dictionaries that these
// files seem to be meant as, so that the caller need not report them as missing as well. Collective.
std::set<std::string> checkFiles(const Application& app, Problems& problems);

// The same for a given list of the files of a case, by their paths in it; folders end with '/'.
std::set<std::string> checkFiles(const std::vector<std::string>& files, Problems& problems);

}  // namespace corpuscle::simulation
