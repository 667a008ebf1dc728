#include "core/schemaJson.hpp"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/registry.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* numberPattern = "[+-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?";
constexpr const char* namePattern = "^[A-Za-z][A-Za-z0-9_-]*$";

Json pattern(const std::string& regex) { return {{"type", "string"}, {"pattern", "^" + regex + "$"}}; }

Json numberIn(const Range& range) {
    Json json{{"type", "number"}};
    if (std::isfinite(range.low)) json[range.lowOpen ? "exclusiveMinimum" : "minimum"] = range.low;
    if (std::isfinite(range.high)) json[range.highOpen ? "exclusiveMaximum" : "maximum"] = range.high;
    return json;
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
            Json property = value(f);
            if (!f.alternative.empty()) property = {{"anyOf", {property, {{"const", f.alternative}}}}};
            property["description"] = f.text;
            if (!f.fallback.empty()) property["default"] = defaultValue(f.fallback);
            properties[f.key] = std::move(property);
            if (f.required) required.push_back(f.key);
        }
        Json json{{"type", "object"}, {"description", info.text}, {"properties", properties}};
        json["additionalProperties"] = others;
        if (others != false) json["propertyNames"] = {{"pattern", namePattern}};
        if (!required.empty()) json["required"] = required;
        Json rules = Json::array();
        for (const auto& keys : info.exactlyOne) {
            Json choices = Json::array();
            for (const std::string& k : keys) choices.push_back({{"required", {k}}});
            rules.push_back({{"oneOf", choices}});
        }
        for (const auto& keys : info.atMostOne)
            for (std::size_t i = 0; i < keys.size(); ++i)
                for (std::size_t j = i + 1; j < keys.size(); ++j)
                    rules.push_back({{"not", {{"required", {keys[i], keys[j]}}}}});
        if (!rules.empty()) json["allOf"] = rules;
        return json;
    }

    const Json& definitions() const { return definitions_; }

  private:
    static Json defaultValue(const std::string& fallback) {
        Problems ignored;
        return toJson(parseValue(fallback, "", ignored));
    }

    static Json quantity(Dimension dimension, const Range& range) {
        return dimension.isDimensionless() ? numberIn(range) : pattern(std::string(numberPattern) + " ?[A-Za-z1].*");
    }
    static Json three(Json of) {
        return {{"type", "array"}, {"items", std::move(of)}, {"minItems", 3}, {"maxItems", 3}};
    }

    Json value(const FieldInfo& f) {
        if (f.type == "quantity") return quantity(f.dimension, f.range);
        if (f.type == "quantities") return {{"type", "array"}, {"items", quantity(f.dimension, f.range)}};
        if (f.type == "vector") return three(quantity(f.dimension, f.range));
        if (f.type == "integer" || f.type == "integers") {
            Json whole = numberIn(f.range);
            whole["type"] = "integer";
            return f.type == "integer" ? whole : three(whole);
        }
        if (f.type == "boolean") return {{"type", "boolean"}};
        if (f.type == "booleans") return three({{"type", "boolean"}});
        if (f.type == "word") return {{"enum", f.words}};
        if (f.type == "words") {
            const Json words =
                f.words.empty() ? Json{{"type", "string"}, {"pattern", namePattern}} : Json{{"enum", f.words}};
            return {{"type", "array"}, {"items", words}};
        }
        if (f.type == "name") return {{"type", "string"}, {"pattern", namePattern}};
        if (f.type == "text") return {{"type", {"string", "number", "boolean"}}};
        if (f.type == "length") return pattern(std::string(numberPattern) + " ?[a-zA-Z].*");
        if (f.type == "interval") return pattern("(never|" + std::string(numberPattern) + " ?[a-z]+)");
        if (f.type == "list") return {{"type", "array"}, {"items", item(f)}};
        if (f.type == "map" || f.type == "models")
            return {
                {"type", "object"}, {"propertyNames", {{"pattern", namePattern}}}, {"additionalProperties", item(f)}};
        return item(f);
    }

    Json item(const FieldInfo& f) { return f.family.empty() ? table(f.table()) : reference(f.family); }

    Json reference(const std::string& family) {
        if (!definitions_.contains(family)) {
            definitions_[family] = Json::object();  // stands while the models are written: a family may contain itself
            Json choices = Json::array();
            for (const ModelInfo& model : families()[family].models()) {
                Json withSettings = table(model.settings);
                withSettings["description"] = model.text;
                withSettings["properties"]["type"] = {{"const", model.name}};
                withSettings["required"].push_back("type");
                choices.push_back(std::move(withSettings));
                if (!needsSettings(model.settings)) choices.push_back({{"const", model.name}});
            }
            definitions_[family] = {{"anyOf", std::move(choices)}};
        }
        return {{"$ref", "#/definitions/" + escaped(family)}};
    }

    static bool needsSettings(const SchemaInfo& info) {
        for (const FieldInfo& f : info.fields)
            if (f.required) return true;
        return !info.exactlyOne.empty();
    }
    static std::string escaped(std::string name) {
        for (auto at = name.find(' '); at != std::string::npos; at = name.find(' ')) name.replace(at, 1, "%20");
        return name;
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
