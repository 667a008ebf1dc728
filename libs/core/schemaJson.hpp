// JSON Schema (draft 7) of declared settings, for editors and for checks outside of Corpuscle. It accepts what the
// reader accepts, with units and signs (quantityForms.hpp), the range of bare numbers, one branch for each model,
// exactlyOneOf and atMostOneOf. It cannot express the range of a number with a unit (beyond its sign) or of a number in
// quotes, nor rules in check functions or between files.
//
// Besides the standard keywords it has "patternErrorMessage", which editors show as the explanation of a pattern.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "core/settings.hpp"

namespace corpuscle {

// Families that the settings refer to are listed under "definitions" (from the registry of this program).
nlohmann::ordered_json jsonSchema(const SchemaInfo& info);

// Schema of a file that is one model: `type` with its settings beside it.
nlohmann::ordered_json jsonSchemaOfModel(const std::string& title, const std::string& description,
                                         const std::string& family);

// A dictionary as JSON: plain numbers and true/false as such, every other scalar as text.
nlohmann::ordered_json toJson(const Node& node);

}  // namespace corpuscle
