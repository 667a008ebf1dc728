// Which files a case may hold in system/ and constant/. A dictionary that no program reads is a fault: a misspelt
// observers.yaml would be passed over without a word.
//
// Passed over are hidden files, backups of editors (x~, #x#, .bak, .orig, .swp, ...), README and the like, folders, and
// files of other kinds (surfaces, pictures, tables): a dictionary names those that it needs.
#pragma once
#include <set>
#include <string>
#include <vector>

#include "core/application.hpp"

namespace corpuscle::simulation {

// "system/control.yaml", ...: all that any program reads.
const std::vector<std::string>& dictionaryFiles();

// Adds a problem for each file that looks like a dictionary and is none. Returns the missing dictionaries that these
// seem to be meant for: it need not be said as well that they are missing. Collective.
std::set<std::string> checkFiles(const Application& app, Problems& problems);

// The same for a list of files as they stand in the case, folders with a '/' at the end.
std::set<std::string> checkFiles(const std::vector<std::string>& files, Problems& problems);

}  // namespace corpuscle::simulation
