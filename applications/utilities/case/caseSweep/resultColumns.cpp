#include "resultColumns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/atomicFile.hpp"
#include "observers/observers.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

// Columns of each table, by observer and file.
using Tables = std::map<std::string, std::map<std::string, std::vector<std::string>>>;

std::vector<std::string> namesIn(const Node& mesh, const char* key) {
    std::vector<std::string> names;
    const Node* const list = mesh.find(key);
    for (const Node& item : list ? list->items : std::vector<Node>{})
        if (const Node* name = item.find("name")) names.push_back(name->scalar);
    return names;
}

Tables tablesOf(const Node& observersNode, const Node& mesh) {
    observers::SceneParts parts = observers::SceneParts::all();
    parts.cells = namesIn(mesh, "cells");
    parts.bodies = namesIn(mesh, "bodies");
    Problems ignored;  // the dictionaries are checked elsewhere
    Tables tables;
    for (const auto& [name, model] : read<observers::ObserversSettings>(observersNode, ignored).models) {
        if (!model) continue;
        for (const observers::Table& table : model->tables(parts)) {
            std::vector<std::string>& columns = tables[name][table.file];
            for (const io::Column& column : table.columns) columns.push_back(column.header());
        }
    }
    return tables;
}

// "force_<wall>_x_N" stands for every name of a wall.
bool matches(const std::string& column, const std::string& declared) {
    const std::string any = "<wall>";
    const std::size_t at = declared.find(any);
    if (at == std::string::npos) return column == declared;
    const std::string before = declared.substr(0, at), after = declared.substr(at + any.size());
    return column.size() > before.size() + after.size() && column.starts_with(before) && column.ends_with(after);
}

template <class Map>
std::vector<std::string> keysOf(const Map& map) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : map) keys.push_back(key);
    return keys;
}

std::string among(const std::string& word, const std::vector<std::string>& known) {
    return (known.empty() ? "none" : joinWords(known)) + "." + didYouMean(word, known);
}

class Checker {
  public:
    Checker(const Node& results, bool knowsPrograms, Problems& problems)
        : results_(results), knowsPrograms_(knowsPrograms), problems_(problems) {}

    // Faults of the tables of one case; each is reported once.
    void check(const std::string& name, const study::ResultSettings& result, const Tables& tables,
               const std::string& ofCase) {
        const std::size_t slash = result.table.find('/');
        const std::string observer = result.table.substr(0, slash);
        if (slash == std::string::npos)
            return add(name, "table",
                       fmt::format("found '{}'; write OBSERVER/FILE, as deformation/rbc for "
                                   "postProcessing/deformation/rbc.csv",
                                   result.table));
        const auto files = tables.find(observer);
        if (files == tables.end()) {
            if (knowsPrograms_)
                add(name, "table",
                    fmt::format("found '{}'; the observers of case {} are {}", result.table, ofCase,
                                among(observer, keysOf(tables))));
            return;
        }
        const std::string file = result.table.substr(slash + 1);
        const auto columns = files->second.find(file);
        if (columns == files->second.end())
            return add(name, "table",
                       fmt::format("found '{}'; the tables of '{}' in case {} are {}", result.table, observer, ofCase,
                                   among(file, keysOf(files->second))));
        if (std::none_of(columns->second.begin(), columns->second.end(),
                         [&](const std::string& declared) { return matches(result.column, declared); }))
            add(name, "column",
                fmt::format("found '{}'; the columns of {} are {}", result.column, result.table,
                            among(result.column, columns->second)));
    }

  private:
    void add(const std::string& name, const char* key, const std::string& message) {
        const Node* const result = results_.find(name);
        const Node* const value = result ? result->find(key) : nullptr;
        if (value && seen_.insert(value->path).second) problems_.add(value->mark, value->path, message);
    }
    const Node& results_;
    bool knowsPrograms_;
    Problems& problems_;
    std::set<std::string> seen_;
};

}  // namespace

void checkResultColumns(const Node& study, const study::StudySettings& settings, const fs::path& templateCase,
                        const std::vector<study::StudyCase>& cases, Problems& problems) {
    const Node* const results = study.find("results");
    // membraneRelax writes tables of its protocol.
    if (!results || fs::exists(templateCase / "system" / "relax.yaml")) return;
    Checker checker(*results, !settings.programs, problems);
    std::set<std::string> seen;  // cases with the same dictionaries have the same tables
    for (const study::StudyCase& one : cases) {
        const auto changed = study::dictionariesWith(templateCase, one.settings);
        const auto textOf = [&](const std::string& file) {
            if (const auto found = changed.find(file); found != changed.end()) return found->second;
            return fs::exists(templateCase / file) ? readFile(templateCase / file) : std::string("{}");
        };
        const std::string observers = textOf("system/observers.yaml"), mesh = textOf("system/mesh.yaml");
        if (!seen.insert(observers + '\0' + mesh).second) continue;
        Problems ignored;
        const Tables tables = tablesOf(parseDictionary(observers, "system/observers.yaml", ignored),
                                       parseDictionary(mesh, "system/mesh.yaml", ignored));
        for (const auto& [name, result] : settings.results) checker.check(name, result, tables, one.name);
    }
}

}  // namespace corpuscle
