// All dictionaries that programs read, with their declared settings; and their JSON schemas in a case, for editors.
//
// The first line of a dictionary names its schema by a path within the case, which stays valid wherever the case is
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

// The files "system/control.yaml", ..., each with its declared settings.
const std::vector<std::pair<std::string, SchemaInfo>>& dictionaries();

// Reads a dictionary by its declared settings, as programs do, and adds a problem for each error. `file`:
// "system/mesh.yaml", "constant/cells/NAME.yaml", "study.yaml". A file with an unknown name is a problem.
void checkDictionary(const std::string& file, const Node& node, Problems& problems);

// Adds the errors that a change of a dictionary's text has introduced.
void addNewProblems(const std::string& file, const std::string& before, const std::string& after, Problems& problems);

// The schema "cell" of constant/cells/NAME.yaml, which is read if system/mesh.yaml names it.
SchemaInfo readyCellInfo();

nlohmann::ordered_json schemaOf(const SchemaInfo& dictionary);

// Writes "<name>.json" for each dictionary, and "cell.json"; returns their paths.
std::vector<std::filesystem::path> writeSchemas(const std::filesystem::path& folder);

// Updates .schema/ of the case where it differs. A case runs without it too, so a folder that cannot be written to is
// not an error. Only the root writes.
void refreshSchemas(const Application& app);

}  // namespace corpuscle::simulation
