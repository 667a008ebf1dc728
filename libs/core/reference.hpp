// The dictionary reference in Markdown, from the declared settings alone.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "core/registry.hpp"

namespace corpuscle {

// One table of keys; nested tables follow as sections of their own, named by their path. `level` is the level of the
// heading.
std::string referenceSection(const std::string& heading, const SchemaInfo& info, int level);

// All models of all families of this program.
std::string referenceOfModels();

// The whole page: one section for each file ("system/control.yaml"), then the models.
std::string referencePage(const std::vector<std::pair<std::string, SchemaInfo>>& files);

}  // namespace corpuscle
