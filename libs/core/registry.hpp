// Models chosen by name. A family is an abstract class; a model is a struct with a schema(), a name and one line of
// text.
//
//     CORPUSCLE_REGISTER(BondLaw, HarmonicBond, "harmonic", "linear spring between two nodes");
//
// In a case: `type: harmonic` with its coefficients beside it, or the bare word when it needs none. Adding a model is
// adding one file; `listModels` prints every family with its models.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/settings.hpp"

namespace corpuscle {

struct ModelInfo {
    std::string name, text;
    SchemaInfo settings;
};

// Type-erased catalogue of all families, for listModels and the generated reference.
struct FamilyInfo {
    std::string name;   // "bond law"
    std::string usual;  // model of a table without `type`; "": `type` is required
    std::function<std::vector<ModelInfo>()> models;
};
std::map<std::string, FamilyInfo>& families();

template <class Family>
class Registry {
  public:
    struct Entry {
        std::string text;
        std::function<SchemaInfo()> settings;
        std::function<std::shared_ptr<const Family>(const Node& node, Problems& problems)> make;
        std::function<Node(const Family&)> write;
    };
    static Registry& instance();
    void add(const std::string& name, Entry entry);
    std::vector<std::string> names() const;
    const Entry* find(const std::string& name) const;

  private:
    Registry();
    std::map<std::string, Entry> entries_;
};

// A model chosen in a case. Family must declare `static constexpr const char* familyName` ("bond law"). In the same way
// it may declare `usualModel`, the model of a table of settings without `type`.
template <class Family>
struct Choice {
    std::string name;                     // "harmonic"; empty: none chosen
    std::shared_ptr<const Family> model;  // its coefficients and functions
    explicit operator bool() const { return static_cast<bool>(model); }
    const Family* operator->() const { return model.get(); }
    const Family& operator*() const { return *model; }
};

// All models of a family, each with the settings that a case gives it in a table of its name.
template <class Family>
struct ModelTables {
    std::map<std::string, std::shared_ptr<const Family>> models;
    // The model with the settings of the case, or with its defaults if the case gives none; null where no model has
    // this name.
    std::shared_ptr<const Family> of(const std::string& name) const;
};

}  // namespace corpuscle

#include "core/registry-inl.hpp"

// At namespace scope of the model's .cpp or header-only translation unit. Model derives from Family and has `static
// const Schema<Model>& schema()`.
#define CORPUSCLE_REGISTER(Family, Model, name, text) \
    static const ::corpuscle::Registration<Family, Model> corpuscleRegistration##Model(name, text)
