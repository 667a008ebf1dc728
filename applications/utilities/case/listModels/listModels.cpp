// listModels: everything that can be chosen in a case: every family of models, every model with its settings, every
// dictionary.
//
// All of this comes from declarations in the libraries, so a new model appears here without further work.
//
// Sample runs:
//     listModels
//     listModels kernel
//     listModels kuchelFackerell
//     listModels -info skalak
//     listModels -markdown
#include <algorithm>
#include <cctype>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/application.hpp"
#include "core/reference.hpp"
#include "membrane/protocol.hpp"
#include "modelInfo.hpp"
#include "observers/observers.hpp"
#include "simulation/dictionaries.hpp"
#include "simulation/restart.hpp"

using namespace corpuscle;
using nlohmann::ordered_json;

namespace {

// Escapes a text for a cell of a Markdown table.
std::string inTable(std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, 1, '\\');
    return text;
}

// A model with its default settings. What it reports about itself does not depend on required settings, which are
// missing here.
template <class Family>
std::shared_ptr<const Family> sample(const std::string& name) {
    Problems missing;
    return Registry<Family>::instance().find(name)->make(Node{}, missing);
}

struct Table {
    std::string file;  // "deformation/<cell>.csv"
    std::vector<io::Column> columns;
};

// The tables that a model writes below postProcessing; most families write none.
std::vector<Table> tablesOf(const std::string& family, const std::string& name) {
    std::vector<Table> all;
    if (family == observers::Observer::familyName)
        for (const auto& table : sample<observers::Observer>(name)->tables(observers::SceneParts::all())) {
            all.push_back({"<name>/" + table.file + ".csv", observers::timeColumns()});
            all.back().columns.insert(all.back().columns.end(), table.columns.begin(), table.columns.end());
        }
    if (family == membrane::Protocol::familyName) {
        const auto protocol = sample<membrane::Protocol>(name);
        all.push_back({"relax/<membrane>.csv", {}});
        for (const auto& some : {protocol->columnsBefore(), protocol->columns(), protocol->columnsAfter()})
            for (const auto& c : some) all.back().columns.push_back({c.name, c.unit, c.meaning});
    }
    return all;
}

std::string tablesPage() {
    std::string text =
        "## Tables\n\nWhat observers and protocols write under postProcessing. Those of `<cell>`, `<body>` and of "
        "walls, body forces, rupture are there where a case has them.\n\n";
    for (const auto& [family, info] : families())
        for (const ModelInfo& model : info.models())
            for (const Table& table : tablesOf(family, model.name)) {
                text += fmt::format("### {} `{}`, {}\n\n| column | unit | meaning |\n|---|---|---|\n", family,
                                    model.name, table.file);
                for (const io::Column& c : table.columns)
                    text += fmt::format("| `{}` | {} | {} |\n", c.header(), c.unitText(), inTable(c.meaning));
                text += '\n';
            }
    return text;
}

ordered_json toJson(const std::string& family, const ModelInfo& model, const ModelCatalogue* more) {
    ordered_json settings = ordered_json::array();
    for (const FieldInfo& f : model.settings.fields) {
        ordered_json field{{"key", f.key}, {"value", f.description()}, {"text", f.text}, {"required", f.required}};
        if (!f.fallback.empty()) field["default"] = f.fallback;
        settings.push_back(std::move(field));
    }
    ordered_json json{{"text", model.text}, {"settings", settings}};
    for (const Table& table : tablesOf(family, model.name))
        for (const io::Column& c : table.columns)
            json["tables"][table.file].push_back(
                {{"column", c.header()}, {"unit", c.unitText()}, {"meaning", c.meaning}});
    if (more) json["info"] = more->json({family, model.name});
    return json;
}

// "bond law", "bondLaw" and "bond-law" are the same.
std::string plain(const std::string& name) {
    std::string text;
    for (const char c : name)
        if (std::isalnum(static_cast<unsigned char>(c)))
            text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::string oneLinePerModel(const std::vector<ModelInfo>& models) {
    std::size_t width = 0;
    for (const ModelInfo& m : models) width = std::max(width, m.name.size());
    std::string text;
    for (const ModelInfo& m : models) text += fmt::format("  {:<{}}  {}\n", m.name, width, m.text);
    return text;
}

void printTable(const SchemaInfo& info, const std::string& path, const std::string& indent) {
    std::vector<std::vector<std::string>> rows;
    for (const FieldInfo& f : info.fields)
        rows.push_back({path + (f.key == "*" ? "<name>" : f.key), f.description(),
                        !f.fallback.empty() ? f.fallback
                        : f.required        ? "required"
                                            : "",
                        f.text});
    if (rows.empty() && path.empty()) std::cout << indent << "no settings\n";
    if (!rows.empty())
        for (const std::string& line : alignedTable({"key", "value", "default", "meaning"}, rows))
            std::cout << indent << line << '\n';
    for (const auto& keys : info.exactlyOne) std::cout << indent << "exactly one of " << joinWords(keys) << '\n';
    for (const auto& keys : info.atMostOne) std::cout << indent << "at most one of " << joinWords(keys) << '\n';
    for (const FieldInfo& f : info.fields)
        if (f.table) {
            std::cout << '\n';
            printTable(f.table(), path + (f.key == "*" ? "<name>" : f.key) + (f.type == "list" ? "[]." : "."), indent);
        }
}

void printModel(const std::string& family, const ModelInfo& model) {
    std::cout << model.name << " (" << family << "): " << model.text << '\n';
    printTable(model.settings, "", "  ");
    for (const Table& table : tablesOf(family, model.name)) {
        std::cout << "\n  postProcessing/" << table.file << ":\n";
        std::vector<std::vector<std::string>> rows;
        for (const io::Column& c : table.columns) rows.push_back({c.header(), c.unitText(), c.meaning});
        for (const std::string& line : alignedTable({"column", "unit", "meaning"}, rows))
            std::cout << "  " << line << '\n';
    }
}

// Shows the family or the models of that name, or all ("") models; a dictionary is found by the name of its file
// ("numerics"). more: says where models are written, explained and used; null: not asked for.
void show(const std::string& wanted, bool asJson, const ModelCatalogue* more) {
    ordered_json json = ordered_json::object();
    std::vector<std::string> known;
    bool found = false;
    for (const auto& [name, family] : families()) {
        const bool all = wanted.empty() || plain(name) == plain(wanted);
        known.push_back(name);
        for (const ModelInfo& model : family.models()) {
            known.push_back(model.name);
            if (!all && plain(model.name) != plain(wanted)) continue;
            if (asJson)
                json[name][model.name] = toJson(name, model, more);
            else {
                if (found) std::cout << '\n';
                printModel(name, model);
                if (more) std::cout << '\n' << more->text({name, model.name});
            }
            found = true;
        }
    }
    for (const auto& [file, info] : simulation::dictionaries()) {
        known.push_back(info.name);
        if (found || plain(info.name) != plain(wanted)) continue;
        found = true;
        if (asJson)
            json[file] = simulation::schemaOf(info);
        else {
            std::cout << info.text << '\n';
            printTable(info, "", "  ");
        }
    }
    if (!found)
        throw Failure(ExitCode::usage, "there is no family, model or dictionary '" + wanted + "'." +
                                           didYouMean(wanted, known) + " Known: " + joinWords(known));
    if (asJson)
        std::cout << json.dump(2) << '\n';
    else if (more)
        std::cout << "\nPaths are within " << more->root().string() << ".\n";
}

// The libraries of models that the case names.
std::vector<std::string> pluginsOf(const Application& app) {
    std::vector<std::string> libraries;
    for (const char* file : {"system/control.yaml", "system/relax.yaml"}) {
        Problems ignored;
        if (!app.hasDictionary(file)) continue;
        const Node dictionary = app.dictionary(file, ignored);
        const Node* libs = dictionary.find("libs");
        for (const Node& item : libs ? libs->items : std::vector<Node>{}) libraries.push_back(item.scalar);
    }
    return libraries;
}

void showAll(bool asJson) {
    ordered_json json = ordered_json::object();
    for (const auto& [name, family] : families()) {
        if (!asJson) std::cout << name << '\n' << oneLinePerModel(family.models()) << '\n';
        for (const ModelInfo& model : family.models()) json[name][model.name] = toJson(name, model, nullptr);
    }
    if (asJson)
        std::cout << json.dump(2) << '\n';
    else
        std::cout
            << "listModels NAME shows the settings of a family, a model or a dictionary (control, numerics, ...).\n";
}

}  // namespace

int main(int argc, char* argv[]) {
    Application app(
        "listModels", "Shows the models that a case can choose, and their settings.", argc, argv,
        {.options = {{"info", "", "Also where the model is written, explained and used: sources, pages, tutorials."},
                     {"markdown", "", "The whole dictionary reference, as docs/dictionaries.md has it."},
                     {"schema", "DIR", "Write a JSON schema for each dictionary into DIR."}},
         .arguments = {{"NAME", "", "A family (kernel, bondLaw), a model (wendlandC2) or a dictionary (numerics)."}},
         .optionalArguments = 1,
         .samples = {"listModels", "listModels kernel", "listModels kuchelFackerell", "listModels -info skalak",
                     "listModels -markdown"}});
    return app.run([&] {
        const std::vector<std::string> plugins = pluginsOf(app);
        if (!app.communicator().isRoot()) return ExitCode::done;
        if (const auto folder = app.value("schema"))
            for (const std::filesystem::path& file : simulation::writeSchemas(*folder))
                std::cout << file.string() << '\n';
        else if (app.has("markdown"))
            std::cout << referencePage(simulation::dictionaries()) << restartPage(simulation::restartDictionaries())
                      << tablesPage();
        else if (app.has("info") || !app.arguments().empty())
            show(app.arguments().empty() ? "" : app.arguments().front(), app.json(),
                 app.has("info") ? std::make_unique<ModelCatalogue>(plugins).get() : nullptr);
        else
            showAll(app.json());
        return ExitCode::done;
    });
}
