#include "modelUses.hpp"

#include <algorithm>
#include <functional>
#include <optional>

#include "core/caseFolder.hpp"
#include "core/registry.hpp"
#include "schemes/scheme.hpp"
#include "simulation/dictionaries.hpp"
#include "sph/flow.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

// The integrator is declared as a word, because `automatic` and the tables of all schemes stand beside it.
std::string familyOf(const FieldInfo& field) {
    return field.key == "integrator" ? schemes::Scheme::familyName : field.family;
}

std::optional<SchemaInfo> settingsOf(const ModelId& id) {
    const auto family = families().find(id.first);
    if (family == families().end()) return {};
    for (ModelInfo& model : family->second.models())
        if (model.name == id.second) return std::move(model.settings);
    return {};
}

class Finder {
  public:
    explicit Finder(ModelUses& uses) : uses_(uses) {}

    void table(const SchemaInfo& info, const Node& node) {
        if (node.kind != Node::Kind::table) return;
        for (const auto& [key, value] : node.entries) {
            const auto declared = [&](const std::string& name) {
                return std::find_if(info.fields.begin(), info.fields.end(),
                                    [&](const FieldInfo& f) { return f.key == name; });
            };
            auto found = declared(key);
            if (found == info.fields.end()) found = declared("*");
            if (found != info.fields.end()) field(*found, value);
        }
    }
    void model(const std::string& family, const Node& node) {
        const bool isTable = node.kind == Node::Kind::table;
        const Node* type = isTable ? node.find("type") : &node;
        const auto known = families().find(family);
        if (known == families().end() || (type && type->kind != Node::Kind::scalar)) return;
        const ModelId id{family, type ? type->scalar : known->second.usual};
        const std::optional<SchemaInfo> settings = settingsOf(id);
        if (!settings) return;  // `none`, `automatic`, or a model of a plugin
        uses_[id].push_back(type ? type->mark : node.place());
        if (isTable) table(*settings, node);
    }

  private:
    void field(const FieldInfo& info, const Node& node) {
        const bool isNamed = (info.type == "map" || info.type == "models") && info.key != "*";
        const auto one = [&](const Node& value) {
            if (const std::string family = familyOf(info); !family.empty())
                model(family, value);
            else if (info.table)
                table(info.table(), value);
        };
        if (isNamed)
            for (const auto& [key, value] : node.entries) one(value);
        else if (info.type == "list")
            for (const Node& item : node.items) one(item);
        else
            one(node);
    }
    ModelUses& uses_;
};

// A dictionary by its path in a case, with its declared settings; empty: another file.
std::optional<std::pair<std::string, SchemaInfo>> dictionaryOf(const fs::path& file) {
    const std::string folder = file.parent_path().filename().string();
    const std::string inCase = folder + "/" + file.filename().string();
    if (folder == "cells" && file.extension() == ".yaml") return std::pair{inCase, simulation::readyCellInfo()};
    for (const auto& [name, info] : simulation::dictionaries())
        if (name == inCase || name == file.filename().string()) return std::pair{name, info};
    return {};
}

std::vector<fs::path> filesBelow(const fs::path& folder) {
    std::vector<fs::path> files;
    if (!fs::is_directory(folder)) return files;
    for (auto at = fs::recursive_directory_iterator(folder); at != fs::recursive_directory_iterator(); ++at) {
        if (isOutput(at->path()))
            at.disable_recursion_pending();
        else if (at->is_regular_file() && at->path().extension() == ".yaml")
            files.push_back(at->path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

ModelUses findUses(const fs::path& folder, const fs::path& root) {
    ModelUses uses;
    Finder finder(uses);
    for (const fs::path& file : filesBelow(folder)) {
        const auto known = dictionaryOf(file);
        if (!known) continue;
        Problems ignored;
        const Node node = readDictionary(file, file.lexically_relative(root).string(), ignored);
        if (known->first == "constant/flow.yaml")
            finder.model(sph::Flow::familyName, node);
        else
            finder.table(known->second, node);
    }
    return uses;
}

namespace {

// Every declared field of every dictionary and model.
void eachField(const std::function<void(const FieldInfo&)>& visit) {
    const std::function<void(const SchemaInfo&)> all = [&](const SchemaInfo& info) {
        for (const FieldInfo& f : info.fields) {
            visit(f);
            if (f.table) all(f.table());
        }
    };
    for (const auto& [file, info] : simulation::dictionaries()) all(info);
    for (const auto& [name, family] : families())
        for (const ModelInfo& model : family.models()) all(model.settings);
}

}  // namespace

std::map<std::string, std::vector<std::string>> keysOfFamilies() {
    std::map<std::string, std::vector<std::string>> keys;
    eachField([&](const FieldInfo& f) {
        const std::string family = familyOf(f);
        if (family.empty() || f.key == "*") return;
        auto& all = keys[family];
        if (std::find(all.begin(), all.end(), f.key) == all.end()) all.push_back(f.key);
    });
    return keys;
}

std::set<std::string> allKeys() {
    std::set<std::string> keys;
    eachField([&](const FieldInfo& f) { keys.insert(f.key); });
    return keys;
}

}  // namespace corpuscle
