// JSON Schema (draft 7) of declared settings, for editors and for checks outside of Corpuscle. It is looser than the
// reader: units are a pattern, rules over several keys beyond exactlyOneOf are not expressed.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "core/settings.hpp"

namespace corpuscle {

// Families that are named stand under "definitions" (from the registry of this program).
nlohmann::ordered_json jsonSchema(const SchemaInfo& info);

// A dictionary as JSON: plain numbers and true/false as such, every other scalar as text, a list with a unit after it
// as the text that stands in the file ("[1 um, 2 um, 3 um]").
nlohmann::ordered_json toJson(const Node& node);

}  // namespace corpuscle
