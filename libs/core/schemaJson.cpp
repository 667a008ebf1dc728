#include "core/schemaJson.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/quantityForms.hpp"
#include "core/registry.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

// Pattern for the whole text; '$' alone would allow a newline to follow.
std::string whole(const std::string& pattern) { return "^(?:" + withUnicode(pattern) + ")$(?!\\n)"; }

Json text(const std::string& pattern, const std::string& expected = "") {
    Json json{{"type", "string"}, {"pattern", whole(pattern)}};
    if (!expected.empty()) json["patternErrorMessage"] = expected;  // shown by editors
    return json;
}

std::string nameText() { return std::string("(?!(?:") + reservedWords + ")$)" + namePattern; }

std::string escaped(const std::string& word) {
    std::string pattern;
    for (const char c : word) {
        if (std::string_view(".+*?()[]{}|^$\\/").find(c) != std::string_view::npos) pattern += '\\';
        pattern += c;
    }
    return pattern;
}

std::string orWords(const std::vector<std::string>& words, const std::string& pattern) {
    std::string all;
    for (const std::string& w : words) all += escaped(w) + "|";
    return all + pattern;
}

class Writer {
  public:
    Json table(const SchemaInfo& info) {
        Json properties = Json::object(), required = Json::array();
        Json others = false;
        for (const FieldInfo& f : info.fields) {
            if (f.key == "*") {
                others = item(f);
                continue;
            }
            Json property{{"description", f.text}};
            if (!f.fallback.empty()) property["default"] = defaultValue(f.fallback);
            property.update(value(f));
            property["description"] = f.text;  // of the key, not of the table that it holds
            properties[f.key] = std::move(property);
            if (f.required) required.push_back(f.key);
        }
        Json json{{"type", "object"}, {"description", info.text}, {"properties", properties}};
        json["additionalProperties"] = others;
        if (others != false) json["propertyNames"] = {{"pattern", whole(nameText())}};
        if (!required.empty()) json["required"] = required;
        Json rules = Json::array();
        for (const auto& keys : info.exactlyOne) {
            // If none of the other keys is given, the first is required: a message then names a key.
            Json given = Json::array();
            for (std::size_t i = 1; i < keys.size(); ++i) given.push_back({{"required", {keys[i]}}});
            rules.push_back({{"if", {{"not", {{"anyOf", given}}}}}, {"then", {{"required", {keys[0]}}}}});
            exclude(keys, rules);
        }
        for (const auto& keys : info.atMostOne) exclude(keys, rules);
        if (!rules.empty()) json["allOf"] = rules;
        return json;
    }

    // A table with `type` and the settings of the model of that name beside it.
    Json reference(const std::string& family) {
        if (!definitions_.contains(family)) {
            definitions_[family] = Json::object();  // named before it is filled: a family may contain itself
            Json names = Json::array(), branches = Json::array();
            const std::string usual = families()[family].usual;
            for (const ModelInfo& model : families()[family].models()) {
                names.push_back(model.name);
                Json withSettings = table(model.settings);
                withSettings["description"] = model.text;
                withSettings["properties"]["type"] = {{"const", model.name}};
                Json isThis;
                if (model.name != usual) isThis["required"] = {"type"};
                isThis["properties"] = {{"type", {{"const", model.name}}}};
                branches.push_back({{"if", isThis}, {"then", std::move(withSettings)}});
            }
            Json definition{{"type", "object"}};
            if (usual.empty()) definition["required"] = {"type"};
            definition["properties"] = {{"type", {{"enum", names}}}};
            definition["allOf"] = std::move(branches);
            definitions_[family] = std::move(definition);
        }
        std::string pointer = family;
        for (auto at = pointer.find(' '); at != std::string::npos; at = pointer.find(' '))
            pointer.replace(at, 1, "%20");
        return {{"$ref", "#/definitions/" + pointer}};
    }

    const Json& definitions() const { return definitions_; }

  private:
    static Json defaultValue(const std::string& fallback) {
        Problems ignored;
        return toJson(parseValue(fallback, "", ignored));
    }

    static void exclude(const std::vector<std::string>& keys, Json& rules) {
        for (std::size_t i = 0; i < keys.size(); ++i)
            for (std::size_t j = i + 1; j < keys.size(); ++j)
                rules.push_back({{"not", {{"required", {keys[i], keys[j]}}}}});
    }

    // A bare number, checked against its range. Of one given as text (in quotes, or 1e-3 for readers of YAML 1.1) only
    // the form is checked.
    static Json number(const char* type, Range range, const std::string& pattern, const FieldInfo& f) {
        Json json{{"type", {type, "string"}}};
        const bool isWhole = std::string_view(type) == "integer";
        const double largest = isWhole ? largestInteger : largestNumber;
        if (!std::isfinite(range.low)) range.low = -largest, range.lowOpen = !isWhole;
        if (!std::isfinite(range.high)) range.high = largest, range.highOpen = !isWhole;
        if (range.low == 0 && range.lowOpen) range = {leastNumber, range.high, false, range.highOpen};
        json[range.lowOpen ? "exclusiveMinimum" : "minimum"] = range.low;
        json[range.highOpen ? "exclusiveMaximum" : "maximum"] = range.high;
        json["pattern"] = whole(pattern);
        json["patternErrorMessage"] = f.description();
        return json;
    }

    static Json quantity(const FieldInfo& f, const std::vector<std::string>& words) {
        const std::string pattern = orWords(words, quantityPattern(f.dimension, f.range));
        if (f.dimension.isDimensionless()) return number("number", f.range, pattern, f);
        return text(pattern, fmt::format("{}, such as {}", f.description(), f.example()));
    }
    static Json three(Json of) {
        return {{"type", "array"}, {"items", std::move(of)}, {"minItems", 3}, {"maxItems", 3}};
    }
    // A text must be one of these words, any other value must match `other`: the message is then about the one that was
    // meant.
    static Json wordsOr(const std::vector<std::string>& words, Json other) {
        if (words.empty()) return other;
        return {{"if", {{"type", "string"}}}, {"then", {{"enum", words}}}, {"else", std::move(other)}};
    }

    // For simple values the alternative word is part of the pattern.
    Json value(const FieldInfo& f) {
        std::vector<std::string> words;
        if (!f.alternative.empty()) words.push_back(f.alternative);
        if (f.type == "quantity") return quantity(f, words);
        if (f.type == "length")
            return text(orWords(words, lengthPattern(f.range)), f.description() + ", such as 3.0 dx");
        if (f.type == "integer") return number("integer", f.range, orWords(words, integerPattern(f.range)), f);
        if (f.type == "word or quantity")
            return text(orWords(f.words, quantityPattern(f.dimension, f.range)), f.description());
        if (f.type == "word") return {{"enum", f.words}};
        if (f.type == "name") return text(nameText(), "a letter, then letters, digits, '-' and '_'");
        if (f.type == "interval") return text(intervalPattern(), "such as 0.1 strain, 1e-5 s or 100 steps, or never");
        if (f.type == "text") return {{"type", {"string", "number", "boolean"}}};
        if (f.type == "boolean") return {{"type", "boolean"}};
        if (f.type == "model") {
            for (const ModelInfo& model : families()[f.family].models())
                if (!needsSettings(model.settings)) words.push_back(model.name);
            return wordsOr(words, reference(f.family));
        }
        return wordsOr(words, composed(f));
    }

    Json composed(const FieldInfo& f) {
        if (f.type == "quantities") return {{"type", "array"}, {"items", quantity(f, {})}};
        if (f.type == "vector") return three(quantity(f, {}));
        if (f.type == "integers") return three(number("integer", f.range, integerPattern(f.range), f));
        if (f.type == "booleans") return three({{"type", "boolean"}});
        if (f.type == "words")
            return {{"type", "array"}, {"items", f.words.empty() ? text(nameText()) : Json{{"enum", f.words}}}};
        if (f.type == "list") return {{"type", "array"}, {"items", item(f)}};
        if (f.type == "values")
            return {{"type", "array"}, {"items", {{"type", {"string", "number", "boolean", "array", "object"}}}}};
        if (f.type == "map" || f.type == "models")
            return {{"type", "object"},
                    {"propertyNames", {{"pattern", whole(nameText())}}},
                    {"additionalProperties", item(f)}};
        return item(f);
    }

    // Schema of one item of a list or a map.
    Json item(const FieldInfo& f) {
        if (f.family.empty()) return table(f.table());
        FieldInfo model = f;
        model.type = "model";
        return value(model);
    }

    static bool needsSettings(const SchemaInfo& info) {
        for (const FieldInfo& f : info.fields)
            if (f.required) return true;
        return !info.exactlyOne.empty();
    }

    Json definitions_ = Json::object();
};

}  // namespace

nlohmann::ordered_json jsonSchema(const SchemaInfo& info) {
    Writer writer;
    Json json{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", info.name}};
    json.update(writer.table(info));
    if (!writer.definitions().empty()) json["definitions"] = writer.definitions();
    return json;
}

nlohmann::ordered_json jsonSchemaOfModel(const std::string& title, const std::string& description,
                                         const std::string& family) {
    Writer writer;
    const Json model = writer.reference(family);
    return {{"$schema", "http://json-schema.org/draft-07/schema#"},
            {"title", title},
            {"description", description},
            {"allOf", {model}},
            {"definitions", writer.definitions()}};
}

nlohmann::ordered_json toJson(const Node& node) {
    if (node.kind == Node::Kind::table) {
        Json json = Json::object();
        for (const auto& [key, value] : node.entries) json[key] = toJson(value);
        return json;
    }
    if (node.kind == Node::Kind::list) {
        Json json = Json::array();
        for (const Node& item : node.items) json.push_back(toJson(item));
        return json;
    }
    if (node.isNothing()) return nullptr;
    const std::string& text = node.scalar;
    if (node.quoted) return text;
    if (text == "true" || text == "false") return text == "true";
    const char* const last = text.data() + text.size();
    long whole = 0;
    if (const auto [end, error] = std::from_chars(text.data(), last, whole); error == std::errc() && end == last)
        return whole;
    double real = 0;
    if (const auto [end, error] = std::from_chars(text.data(), last, real);
        error == std::errc() && end == last && std::isfinite(real))
        return real;
    return text;
}

}  // namespace corpuscle
