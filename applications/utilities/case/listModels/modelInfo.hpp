// Where a model is written, explained and used: its sources and tests, the sections of the documentation, the cases.
//
// Pages and cases are those beside the programs (share/corpuscle of an installed tree), or else those of the sources
// that the programs were built from. Of sources and tests, etc/modelIndex wrote the list share/corpuscle/models.json
// when Corpuscle was built; headers are also in include/corpuscle of an installed tree.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "modelPages.hpp"
#include "modelUses.hpp"

namespace corpuscle {

class ModelCatalogue {
  public:
    // plugins: libraries of a case. Models of these are no part of the sources.
    explicit ModelCatalogue(std::vector<std::string> plugins);

    std::string text(const ModelId& model) const;  // lines, indented by two blanks
    nlohmann::ordered_json json(const ModelId& model) const;
    // What the paths are relative to.
    const std::filesystem::path& root() const { return root_; }

  private:
    struct Group {
        std::string name, none;  // "tutorials", "no tutorial names it"
        ModelUses uses;
    };
    nlohmann::json sourceOf(const ModelId& model) const;  // of the index; null: none
    std::string headerOf(const nlohmann::json& source) const;
    std::string missingSource() const;
    std::string inSources(const std::string& file) const;  // says where it is, if it is not installed
    ModelNames namesOf(const ModelId& model) const;

    std::vector<std::string> plugins_;
    std::filesystem::path root_, headers_;
    nlohmann::json index_;
    std::vector<Section> sections_;
    std::vector<Group> groups_;
    std::map<std::string, std::vector<std::string>> keys_;
    std::map<std::string, int> meanings_;  // number of families and keys that have a name
};

}  // namespace corpuscle
