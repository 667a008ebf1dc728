// Models written by users, in shared libraries: `libs: [myLaw.so]` in system/control.yaml or system/relax.yaml.
//
// A library is loaded before anything else of the case is read; its models register themselves (core/registry.hpp) and
// are chosen by name like all others. A path is relative to the case directory; a name without '/' that is not found
// there is searched as the system searches for libraries (LD_LIBRARY_PATH). The function corpuscle_plugin() of the
// CMake package builds a plugin; etc/newModel KIND NAME -plugin FOLDER writes one to start from.
//
// A plugin is compiled against the headers of one version of Corpuscle. It reports this version (by the function below,
// which corpuscle_plugin() adds), and a plugin of another version is rejected.
#pragma once
#include <filesystem>

#include "core/application.hpp"

// Exported by a plugin: the version of Corpuscle that it was built with, "0.2.0".
extern "C" using CorpusclePluginVersion = const char * ();

namespace corpuscle {

inline constexpr const char* pluginVersionFunction = "corpusclePluginVersion";

// Collective. Loads the libraries of the program's own case, on every rank. Throws CaseError with the place of each
// library that is missing or cannot be loaded. Libraries that are loaded already stay loaded.
void loadPlugins(const Application& app);

// The same for another case, on this process alone: for the template of a study.
void loadPlugins(const std::filesystem::path& caseDir);

}  // namespace corpuscle
