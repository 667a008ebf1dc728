// All dictionaries that programs read, with their declared settings; and their JSON schemas in a case, for editors.
//
// The first line of a dictionary names its schema by a path within the case, so that it holds wherever the case is
// copied to:
//     # yaml-language-server: $schema=../.schema/mesh.json
// membraneMesh, particleFill and the solvers write .schema/ to match their own version.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/application.hpp"
#include "core/settings.hpp"

namespace corpuscle::simulation {

// "system/control.yaml", ... with what is declared for it.
const std::vector<std::pair<std::string, SchemaInfo>>& dictionaries();

// Reads a dictionary by its declared settings, as programs do, and adds what is wrong with it. `file`:
// "system/mesh.yaml", "constant/cells/NAME.yaml", "study.yaml". A file of another name is a problem.
void checkDictionary(const std::string& file, const Node& node, Problems& problems);

// What is wrong with the text of a dictionary after a change, and was not before it.
void addNewProblems(const std::string& file, const std::string& before, const std::string& after, Problems& problems);

// "cell", of constant/cells/NAME.yaml, which is read where system/mesh.yaml names it.
SchemaInfo readyCellInfo();

nlohmann::ordered_json schemaOf(const SchemaInfo& dictionary);

// One "<name>.json" for each dictionary and "cell.json"; returns their paths.
std::vector<std::filesystem::path> writeSchemas(const std::filesystem::path& folder);

// Brings .schema/ of the case up to date where it differs. Without it a case runs as well, so that a folder that cannot
// be written to is no fault. Only the root writes.
void refreshSchemas(const Application& app);

}  // namespace corpuscle::simulation
