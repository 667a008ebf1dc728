// cleanCase: removes what solvers have written into a case: results/, postProcessing/, checkpoints/, log.*, run.json,
// used.yaml and the stop file. The mesh and the particles in 0/ stay unless -mesh is given. In 0/ only .vtp files are
// removed. Files that Corpuscle does not write are never touched.
//
// Sample runs:
//     cleanCase
//     cleanCase -mesh -dry-run
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/application.hpp"
#include "core/caseFolder.hpp"
#include "core/error.hpp"

using namespace corpuscle;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> removable(const fs::path& caseDir, bool withMesh) {
    std::vector<fs::path> found;
    const std::vector<std::string> names{"results", "postProcessing", "checkpoints", "run.json", "used.yaml", "stop"};
    for (const auto& entry : fs::directory_iterator(caseDir)) {
        const std::string name = entry.path().filename().string();
        if (std::find(names.begin(), names.end(), name) != names.end() || name.starts_with("log."))
            found.push_back(entry.path());
    }
    if (withMesh && fs::is_directory(caseDir / "0"))
        for (const auto& entry : fs::directory_iterator(caseDir / "0"))
            if (entry.path().extension() == ".vtp") found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace

int main(int argc, char* argv[]) {
    Application app("cleanCase", "Removes the results of a case.", argc, argv,
                    {.options = {{"mesh", "", "Also the mesh and the particles in 0/."},
                                 {"dry-run", "", "Show what would be removed; remove nothing."}},
                     .samples = {"cleanCase", "cleanCase -mesh -dry-run"}});
    return app.run([&] {
        if (!app.communicator().isRoot()) return ExitCode::done;
        const fs::path caseDir = app.caseDirectory();
        requireCase(caseDir);
        if (!app.has("dry-run")) app.lockCase();
        nlohmann::json removed = nlohmann::json::array();
        for (const fs::path& path : removable(caseDir, app.has("mesh"))) {
            const std::string name = path.lexically_relative(caseDir).string();
            if (!app.has("dry-run")) fs::remove_all(path);
            app.log().info("{}{}", app.has("dry-run") ? "would remove " : "removed ", name);
            removed.push_back(name);
        }
        if (removed.empty()) app.log().info("nothing to remove");
        std::error_code ignored;
        if (app.has("mesh") && !app.has("dry-run")) fs::remove(caseDir / "0", ignored);  // only if it is empty
        if (app.json()) std::cout << removed.dump(2) << '\n';
        return ExitCode::done;
    });
}
