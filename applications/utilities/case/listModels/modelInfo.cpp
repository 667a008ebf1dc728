#include "modelInfo.hpp"

#include <fmt/format.h>

#include <fstream>
#include <utility>

#include "core/error.hpp"
#include "core/registry.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using nlohmann::ordered_json;

// The folder that has bin/ in it.
fs::path prefix() {
    std::error_code ignored;
    return fs::read_symlink("/proc/self/exe", ignored).parent_path().parent_path();
}

Json readIndex(const fs::path& file) {
    std::ifstream stream(file);
    return stream ? Json::parse(stream, nullptr, false) : Json();
}

std::string place(const Mark& mark) { return fmt::format("{}:{}", mark.file, mark.line); }
std::string place(const Section& section) { return section.page + "#" + section.anchor; }

// A row of the output: its name, then one line for each item.
std::string row(const std::string& name, const std::vector<std::string>& items) {
    std::string text;
    for (std::size_t i = 0; i < items.size(); ++i)
        text += fmt::format("  {:<11} {}\n", i == 0 ? name : std::string(), items[i]);
    return text;
}

}  // namespace

ModelCatalogue::ModelCatalogue(std::vector<std::string> plugins) : plugins_(std::move(plugins)) {
    const fs::path share = prefix() / "share" / "corpuscle";
    index_ = readIndex(share / "models.json");
    const bool isInstalled = fs::is_directory(share / "docs");
    root_ = isInstalled ? share : index_.is_object() ? fs::path(index_.value("root", std::string())) : fs::path();
    headers_ = isInstalled ? prefix() / "include" / "corpuscle" : root_ / "libs";
    sections_ = readSections(root_ / "docs", root_);
    groups_ = {{"tutorials", "no tutorial names it", findUses(root_ / "tutorials", root_)},
               {"ready cells", "", findUses(isInstalled ? root_ / "cells" : root_ / "etc" / "cells", root_)},
               {"validation", "", findUses(root_ / "tests" / "validation", root_)}};
    keys_ = keysOfFamilies();
    for (const auto& [name, family] : families())
        for (const ModelInfo& model : family.models()) ++meanings_[model.name];
    for (const std::string& key : allKeys()) ++meanings_[key];
}

Json ModelCatalogue::sourceOf(const ModelId& model) const {
    Json none;
    if (!index_.contains("models")) return none;
    return index_["models"].value(model.first, Json::object()).value(model.second, none);
}

std::string ModelCatalogue::headerOf(const Json& source) const {
    std::string header = source.at("header");
    if (header.empty() || fs::exists(root_ / header)) return header;
    return (headers_ / fs::path(header).lexically_relative("libs")).string();
}

std::string ModelCatalogue::inSources(const std::string& file) const {
    const fs::path path = root_ / file.substr(0, file.find(':'));
    return fs::exists(path) ? file : file + " (in the repository)";
}

std::string ModelCatalogue::missingSource() const {
    if (index_.is_null()) return "unknown: share/corpuscle/models.json, which the build writes with Python, is missing";
    if (plugins_.empty()) return "not in libs/ of the sources";
    return "no part of Corpuscle: a plugin, from " + joinWords(plugins_, " or ");
}

ModelNames ModelCatalogue::namesOf(const ModelId& model) const {
    const auto keys = keys_.find(model.first);
    return {keys == keys_.end() ? std::vector<std::string>{} : keys->second, meanings_.at(model.second) > 1};
}

std::string ModelCatalogue::text(const ModelId& model) const {
    std::string text;
    if (const Json source = sourceOf(model); source.is_null()) {
        text += row("source", {missingSource()});
    } else {
        std::vector<std::string> files{
            inSources(fmt::format("{}:{}", source.at("source").get<std::string>(), source.at("line").get<int>()))};
        if (const std::string header = headerOf(source); !header.empty()) files.insert(files.begin(), header);
        std::vector<std::string> tests = source.at("tests").get<std::vector<std::string>>();
        for (std::string& test : tests) test = inSources(test);
        text +=
            row("source", files) + row("tests", tests.empty() ? std::vector<std::string>{"no test names it"} : tests);
    }
    std::vector<std::string> pages;
    for (const Section* section : sectionsAbout(sections_, model, namesOf(model)))
        pages.push_back(fmt::format("{}  ({})", place(*section), section->heading));
    text += row("theory", pages.empty() ? std::vector<std::string>{"no page names it"} : pages);
    for (const Group& group : groups_) {
        std::vector<std::string> lines;
        if (const auto uses = group.uses.find(model); uses != group.uses.end())
            for (const Mark& mark : uses->second) lines.push_back(place(mark));
        if (lines.empty() && !group.none.empty()) lines.push_back(group.none);
        text += row(group.name, lines);
    }
    return text;
}

ordered_json ModelCatalogue::json(const ModelId& model) const {
    ordered_json all;
    if (const Json source = sourceOf(model); !source.is_null())
        all["source"] = {{"file", source.at("source")},
                         {"line", source.at("line")},
                         {"header", headerOf(source)},
                         {"tests", source.at("tests")}};
    else
        all["source"] = {{"missing", missingSource()}};
    all["theory"] = ordered_json::array();
    for (const Section* section : sectionsAbout(sections_, model, namesOf(model)))
        all["theory"].push_back({{"page", section->page}, {"anchor", section->anchor}, {"heading", section->heading}});
    for (const Group& group : groups_) {
        ordered_json& places = all[group.name == "ready cells" ? "readyCells" : group.name] = ordered_json::array();
        if (const auto uses = group.uses.find(model); uses != group.uses.end())
            for (const Mark& mark : uses->second) places.push_back({{"file", mark.file}, {"line", mark.line}});
    }
    return all;
}

}  // namespace corpuscle
