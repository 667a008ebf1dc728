// Models of users, in shared libraries of their own: `libs: [myLaw.so]` in system/control.yaml or system/relax.yaml.
//
// A library is loaded before anything of the case is read; its models register themselves (core/registry.hpp) and are
// chosen by name like all others. A path is taken from the case directory; a name without '/' that is not there is
// looked for as the system looks for libraries (LD_LIBRARY_PATH). The function corpuscle_plugin() of the CMake package
// builds one; etc/newModel KIND NAME -plugin FOLDER writes one to begin with.
//
// A library is compiled against headers of one version: it says which (the function below, which corpuscle_plugin()
// adds), and one of another version is refused.
#pragma once
#include <filesystem>

#include "core/application.hpp"

// Exported by a plugin: the version of Corpuscle that it was built with, "0.1.0".
extern "C" using CorpusclePluginVersion = const char * ();

namespace corpuscle {

inline constexpr const char* pluginVersionFunction = "corpusclePluginVersion";

// Collective: of the program's own case, on every rank. Throws CaseError with the place of each library that is missing
// or cannot be loaded. Libraries that are loaded already stay.
void loadPlugins(const Application& app);

// The same for another case, on this process alone: of a study's template.
void loadPlugins(const std::filesystem::path& caseDir);

}  // namespace corpuscle
