#include "core/plugins.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include "core/buildInfo.hpp"

namespace corpuscle {

namespace fs = std::filesystem;

namespace {

constexpr const char* files[] = {"system/control.yaml", "system/relax.yaml"};

// Loads a library. Returns why this failed; empty: it is loaded.
std::string load(const fs::path& caseDir, const std::string& name) {
    std::error_code ignored;
    const bool isInCase = fs::is_regular_file(caseDir / name, ignored);
    if (!isInCase && name.find('/') != std::string::npos)
        return fmt::format("found '{}'; there is no such file ({})", name, (caseDir / name).string());
    const std::string path = isInCase ? fs::absolute(caseDir / name).string() : name;
    void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_GLOBAL);
    if (!library) {
        const char* reason = dlerror();
        return fmt::format("'{}' cannot be loaded: {}{}", name, reason ? reason : "no reason is given",
                           isInCase ? "" : ". A path is taken from the case directory");
    }
    const auto version = reinterpret_cast<CorpusclePluginVersion*>(dlsym(library, pluginVersionFunction));
    if (!version)
        return fmt::format(
            "'{}' is no plugin of Corpuscle: it does not say its version; build it with corpuscle_plugin() "
            "(docs/installation.md)",
            name);
    if (version() != buildInfo().version)
        return fmt::format("'{}' was built with Corpuscle {}, and this is {}; build it anew", name, version(),
                           buildInfo().version);
    return {};
}

// Errors of form, in the list or elsewhere, are reported when the dictionary is read.
void loadFrom(const Node& node, const fs::path& caseDir, Problems& problems) {
    const Node* libs = node.find("libs");
    if (!libs || libs->kind != Node::Kind::list) return;
    for (const Node& item : libs->items) {
        if (item.kind != Node::Kind::scalar || item.isNothing()) continue;
        if (const std::string fault = load(caseDir, item.scalar); !fault.empty())
            problems.add(item.mark, item.path, fault);
    }
}

}  // namespace

void loadPlugins(const Application& app) {
    Problems problems;
    for (const char* file : files) {
        if (!app.hasDictionary(file)) continue;
        Problems ignored;
        loadFrom(app.dictionary(file, ignored), app.caseDirectory(), problems);
    }
    problems.throwIfAny();
}

void loadPlugins(const fs::path& caseDir) {
    Problems problems;
    for (const char* file : files) {
        std::error_code none;
        if (!fs::is_regular_file(caseDir / file, none)) continue;
        Problems ignored;
        loadFrom(readDictionary(caseDir / file, file, ignored), caseDir, problems);
    }
    problems.throwIfAny();
}

}  // namespace corpuscle
