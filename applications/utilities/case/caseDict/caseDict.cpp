// caseDict: shows, changes, adds, removes and compares entries in the dictionaries of a case, keeping comments and
// layout.
//
// Before anything is written, the changed dictionary is read in the same way as the solvers and utilities read it: a
// misspelt key or a wrong unit is rejected, all problems are reported, and no file is changed.
//
// Sample runs:
//     caseDict system/mesh.yaml:/cells/0/edge
//     caseDict -set constant/flow.yaml:/Ca=0.1
//     caseDict -remove system/control.yaml:/stop -set system/control.yaml:/endStrain=12
//     caseDict -compare ../other
#include <fmt/format.h>

#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "core/application.hpp"
#include "core/atomicFile.hpp"
#include "core/caseFolder.hpp"
#include "core/dictionaryEdit.hpp"
#include "core/error.hpp"
#include "core/schemaJson.hpp"
#include "simulation/dictionaries.hpp"

using namespace corpuscle;
namespace fs = std::filesystem;

namespace {

Usage usage() {
    return {.options = {{"remove", "ENTRY", "Take out FILE:/path; several are separated by commas."},
                        {"compare", "CASE", "Show the entries that differ from those of another case."},
                        {"keys", "", "Show the keys of a table, without their values."}},
            .arguments = {{"ENTRY", "", "What to show: FILE:/path, or FILE for all of it."}},
            .optionalArguments = 1,
            .samples = {"caseDict constant/flow.yaml:/Ca", "caseDict -set constant/flow.yaml:/Ca=0.1",
                        "caseDict -remove system/control.yaml:/stop", "caseDict -compare ../other"}};
}

struct Entry {
    std::string file, path;
};

Entry entryOf(const std::string& text) {
    const std::size_t colon = text.find(":/");
    if (colon == 0)
        throw Failure(ExitCode::usage,
                      fmt::format("found '{}'; write FILE:/path, such as constant/flow.yaml:/Ca", text));
    return colon == std::string::npos ? Entry{text, ""} : Entry{text.substr(0, colon), text.substr(colon + 1)};
}

// The text of a dictionary in the case.
std::string textOf(const fs::path& caseDir, const std::string& file) {
    const fs::path normal = fs::path(file).lexically_normal();
    if (normal.is_absolute() || *normal.begin() == ".." || normal.extension() != ".yaml")
        throw Failure(ExitCode::usage,
                      fmt::format("{}: a dictionary of the case is expected, such as system/mesh.yaml; -case "
                                  "names another case",
                                  file));
    if (fs::is_regular_file(caseDir / file)) return readFile(caseDir / file);
    const std::vector<std::string> known = dictionariesOf(caseDir);
    throw Failure(ExitCode::invalidCase,
                  fmt::format("{}: the case has no such file.{} It has {}", file, didYouMean(file, known),
                              known.empty() ? "none (is -case right?)" : joinWords(known)));
}

Node parsed(const std::string& text, const std::string& file) {
    Problems problems;
    Node node = parseDictionary(text, file, problems);
    problems.throwIfAny();
    return node;
}

void show(const Application& app, const Entry& entry) {
    const Node root = parsed(textOf(app.caseDirectory(), entry.file), entry.file);
    const Node& node = requiredEntry(root, entry.file, entry.path);
    if (app.has("keys")) {
        for (const auto& [key, value] : node.entries) std::cout << key << '\n';
        for (std::size_t i = 0; i < node.items.size(); ++i) std::cout << i << '\n';
    } else if (app.json()) {
        std::cout << toJson(node).dump(2) << '\n';
    } else if (node.kind == Node::Kind::scalar) {
        std::cout << node.scalar << '\n';
    } else {
        std::cout << emit(node);
    }
}

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        if (end > begin) parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

// Whether all entries to be changed are of dictionaries that a solver reads again while it runs (liveSettings.hpp).
bool areLive(const Application& app) {
    std::vector<std::string> files;
    for (const std::string& removed : split(app.value("remove").value_or(""))) files.push_back(entryOf(removed).file);
    for (const Override& change : app.overrides()) files.push_back(change.file);
    return std::all_of(files.begin(), files.end(), [](const std::string& file) {
        const std::string name = fs::path(file).lexically_normal().string();
        return name == "system/control.yaml" || name == "system/observers.yaml";
    });
}

void change(Application& app) {
    const fs::path caseDir = app.caseDirectory();
    // Locked before reading, so that the text that is changed is the text that was read.
    if (!areLive(app)) app.lockCase();
    std::map<std::string, std::string> before, after;
    const auto text = [&](const std::string& file) -> std::string& {
        const std::string name = fs::path(file).lexically_normal().string();
        if (!after.contains(name)) before[name] = after[name] = textOf(caseDir, name);
        return after[name];
    };
    for (const std::string& removed : split(app.value("remove").value_or(""))) {
        const Entry entry = entryOf(removed);
        std::string& file = text(entry.file);
        file = withoutEntry(file, entry.file, entry.path);
    }
    for (const Override& change : app.overrides()) {
        std::string& file = text(change.file);
        file = withEntry(file, change);
    }
    Problems problems;
    for (const auto& [file, now] : after) simulation::addNewProblems(file, before[file], now, problems);
    problems.throwIfAny();
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const auto& [file, now] : after) {
        if (now == before[file]) continue;
        writeFileAtomically(caseDir / file, now);
        for (const EntryDifference& d : differences(parsed(before[file], file), parsed(now, file))) {
            app.log().info("{}:{}: {} -> {}", file, d.path, d.first.empty() ? "(not there)" : d.first,
                           d.second.empty() ? "(not there)" : d.second);
            json.push_back({{"file", file}, {"path", d.path}, {"before", d.first}, {"now", d.second}});
        }
    }
    if (app.json()) std::cout << json.dump(2) << '\n';
}

void compare(Application& app, const fs::path& other) {
    requireCase(app.caseDirectory());
    requireCase(other);
    std::vector<std::string> files = dictionariesOf(app.caseDirectory());
    for (const std::string& file : dictionariesOf(other))
        if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    std::vector<std::vector<std::string>> rows;
    for (const std::string& file : files) {
        const auto nodeOf = [&](const fs::path& folder) {
            return fs::is_regular_file(folder / file) ? parsed(readFile(folder / file), file) : Node();
        };
        for (const EntryDifference& d : differences(nodeOf(app.caseDirectory()), nodeOf(other))) {
            rows.push_back({file + ":" + d.path, d.first.empty() ? "-" : d.first, d.second.empty() ? "-" : d.second});
            json.push_back({{"file", file}, {"path", d.path}, {"first", d.first}, {"second", d.second}});
        }
    }
    if (app.json())
        std::cout << json.dump(2) << '\n';
    else if (rows.empty())
        std::cout << "All dictionaries say the same.\n";
    else
        for (const std::string& line : alignedTable({"entry", app.caseDirectory().string(), other.string()}, rows))
            std::cout << line << '\n';
}

}  // namespace

int main(int argc, char* argv[]) {
    Application app("caseDict", "Shows, changes, adds, removes and compares entries of a case.", argc, argv, usage());
    return app.run([&] {
        if (!app.communicator().isRoot()) return ExitCode::done;
        const bool changes = app.has("remove") || !app.overrides().empty();
        const int asked = (changes ? 1 : 0) + (app.has("compare") ? 1 : 0) + (app.arguments().empty() ? 0 : 1);
        if (asked != 1)
            throw Failure(ExitCode::usage, asked == 0
                                               ? "say what to do: an ENTRY to show, -set, -remove, or -compare CASE"
                                               : "give one at a time: an ENTRY to show, changes by -set and "
                                                 "-remove, or -compare CASE");
        if (app.has("compare"))
            compare(app, *app.value("compare"));
        else if (changes)
            change(app);
        else
            show(app, entryOf(app.arguments().front()));
        return ExitCode::done;
    });
}
