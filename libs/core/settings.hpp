// A setting is declared once: key, unit, default, range and text. From that one declaration come the reader, the
// errors, the reference page, the JSON schema, `listModels` and used.yaml.
//
//     struct Fluid {
//         double density = 0;                          // kg/m^3
//         std::optional<double> soundSpeed;            // m/s; empty: automatic
//         std::string boundary = "noSlip";
//         static const Schema<Fluid>& schema();
//     };
//     const Schema<Fluid>& Fluid::schema() {
//         static const Schema<Fluid> s = Schema<Fluid>("fluid", "the fluid outside the cells")
//             .quantity("density", &Fluid::density, unit::kilogramPerMetre3, "reference density", {.range = positive})
//             .quantityOr("auto", "soundSpeed", &Fluid::soundSpeed, unit::metrePerSecond, "speed of sound",
//                         {.fallback = "auto"})
//             .word("boundary", &Fluid::boundary, {"noSlip", "freeSlip"}, "condition on the walls",
//                   {.fallback = "noSlip"});
//         return s;
//     }
//     Fluid fluid = read<Fluid>(node, problems);
//
// Kinds of fields (each: key, &T::member, ..., one sentence, {.fallback, .range}); settings-inl.hpp declares them:
//     quantity quantityOr quantities integer boolean word words wordOrQuantity name text values vector vectorOr
//     integers booleans length lengthOr interval table tableOr list map model modelOr models modelTables
// The key "*" of map and models takes every key that is not declared otherwise (a file that is a table of free names).
// Rules over several keys: exactlyOneOf({"Ca", "shearRate"}), atMostOneOf(...), check(function); include<Base>() adds
// the fields of a base struct; atRestart(AtRestart::fixed, {"spacing"}) says what a change means to a continued run.
//
// A field is required unless it has a fallback, or its member is a std::optional (then it stays empty).
// `fallback` is written as a user would write it, and goes through the same parser and checks.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/dictionary.hpp"
#include "core/units.hpp"
#include "core/vec.hpp"

namespace corpuscle {

struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool lowOpen = false, highOpen = false;
    bool contains(double v) const;
    std::string text(Dimension dimension) const;  // "greater than 0", "0 to 1", "" when unlimited
};
inline constexpr Range anyValue{};
inline constexpr Range positive{0, std::numeric_limits<double>::infinity(), true, false};
inline constexpr Range nonNegative{0};
constexpr Range between(double low, double high) { return {low, high, false, false}; }
constexpr Range atLeast(double low) { return {low}; }

// Effect of a changed value on a run that continues from a checkpoint (settingsChange.hpp). A setting that declares no
// policy takes that of the table or model around it; where none is declared, it is fixed.
enum class AtRestart {
    undeclared,
    fixed,     // the state depends on it: the restart is refused
    free,      // it only says when to stop, what to write or to measure
    noted,     // the continued run differs from there on: both values are reported
    resolved,  // it acts through a value that the case derives from it and from other settings, and that value is fixed
};
const char* nameOf(AtRestart policy);

struct FieldOptions {
    std::string fallback = {};  // as written in a case; empty: none
    Range range = {};
};

// A length that may be given in particle spacings ("3.0 dx") or in metres.
struct Length {
    double value = 0;
    bool inSpacings = false;
    double metres(double spacing) const { return inSpacings ? value * spacing : value; }
};

// Interval at which something is done, in strain (gammadot t), time, wall-clock time or steps: "0.02 strain", "1e-5 s",
// "5 min" (a wall-clock interval where the setting says so), "100 steps".
struct Interval {
    enum class Kind { never, strain, time, steps } kind = Kind::never;
    double value = 0;
};

// Description of a field, for the reference page, the JSON schema and help.
struct FieldInfo {
    std::string key;
    // "quantity", "quantities", "integer", "boolean", "word", "words", "word or quantity", "name", "text", "values",
    // "vector", "integers", "booleans", "length", "interval", "table", "list", "map", "model", "models"
    std::string type;
    Dimension dimension;
    std::string text;      // one sentence
    std::string fallback;  // "" when required
    bool required = true;
    Range range;
    std::vector<std::string> words;            // allowed words
    std::function<struct SchemaInfo()> table;  // of a nested table, list item, map item
    std::string family;                        // of a model: name of its family in the registry
    std::string alternative;                   // word allowed instead of the value ("auto", "none", "physical")
    AtRestart atRestart = AtRestart::undeclared;

    std::string example() const;      // a value as a user would write it
    std::string description() const;  // "a quantity in Pa s, greater than 0", "one of noSlip, freeSlip"
};
struct SchemaInfo {
    std::string name, text;
    std::vector<FieldInfo> fields;
    std::vector<std::vector<std::string>> exactlyOne, atMostOne;  // keys that exclude each other
};

template <class T>
class Schema;

// Reads T by T::schema(). Unknown keys, wrong kinds, units, ranges and missing keys go to `problems`; all are found in
// one pass.
template <class T>
T read(const Node& node, Problems& problems);

// The full effective table of a T, defaults included, SI values with units: used.yaml.
template <class T>
Node write(const T& value);

}  // namespace corpuscle

#include "core/settings-inl.hpp"
