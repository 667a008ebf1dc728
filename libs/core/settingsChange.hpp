// Changes between two effective tables of the same declaration: the case that wrote a checkpoint and the case that is
// to continue from it. Each setting declares the effect of a change (AtRestart, settings.hpp). A setting that declares
// none takes that of the table or model around it, and where none is declared it is fixed, so that a new setting cannot
// be forgotten silently.
//
// Values are compared, not their spelling: 11 um and 0.011 mm are the same to 1e-9, and so are 3 dx and 1.5 um where dx
// is 0.5 um.
#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/settings.hpp"

namespace corpuscle {

struct SettingChange {
    std::string key;          // "cells[0].shape.d"
    AtRestart policy;         // never undeclared
    std::string before, now;  // "8 um", "{type: lucy, support: 2 dx}", or "nothing"
};

struct Spacings {
    double before = 0, now = 0;  // dx [m]
};

// A whole dictionary as a field without key: one that is a table, and one that is a model with its `type`.
FieldInfo dictionaryField(std::function<SchemaInfo()> table);
FieldInfo dictionaryField(const std::string& family);

// Changes in the order of declaration. Tables and models are compared entry by entry where both sides have them; models
// of different names are one change.
std::vector<SettingChange> settingChanges(const FieldInfo& dictionary, const Node& before, const Node& now,
                                          Spacings spacings);

// The settings without the free ones, whose change cannot matter: what a checkpoint stores.
Node withoutFree(const FieldInfo& dictionary, const Node& settings);

// Every single setting of a dictionary, those of all models that it may name included: "kernel.lucy.support",
// "cells[].shape.sphere.radius". The policy is undeclared where nothing around the setting declares one.
struct DeclaredSetting {
    std::string key;
    AtRestart policy;
};
std::vector<DeclaredSetting> declaredSettings(const FieldInfo& dictionary);

// A section of the dictionary reference: every setting that declares a policy, by file.
std::string restartPage(const std::vector<std::pair<std::string, FieldInfo>>& dictionaries);

// Text of a value for messages.
std::string shownValue(const Node& value);

}  // namespace corpuscle
