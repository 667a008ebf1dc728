// Where cases choose a model: values of dictionaries that are declared as models of a family, found by the declared
// settings, never by their text.
#pragma once
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/dictionary.hpp"

namespace corpuscle {

// (family, model)
using ModelId = std::pair<std::string, std::string>;
// Files and lines, in the order of their names.
using ModelUses = std::map<ModelId, std::vector<Mark>>;

// All dictionaries below `folder`, other than those that runs have left. Files are shown as paths within `root`.
ModelUses findUses(const std::filesystem::path& folder, const std::filesystem::path& root);

// The keys by which dictionaries choose a model of each family: "bond law": {"bonds"}.
std::map<std::string, std::vector<std::string>> keysOfFamilies();

// All keys of all dictionaries and models.
std::set<std::string> allKeys();

}  // namespace corpuscle
