#include "core/settingsChange.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/registry.hpp"

namespace corpuscle {

namespace {

constexpr double slack = 1e-9;  // relative

AtRestart below(AtRestart around, const FieldInfo& field) {
    return field.atRestart == AtRestart::undeclared ? around : field.atRestart;
}
AtRestart effective(AtRestart policy) { return policy == AtRestart::undeclared ? AtRestart::fixed : policy; }

std::string joined(const std::string& path, const std::string& key) { return path.empty() ? key : path + "." + key; }

std::optional<Quantity> quantityOf(const Node& node) {
    if (node.kind != Node::Kind::scalar || node.quoted) return std::nullopt;
    try {
        return parseQuantity(node.scalar);
    } catch (const std::invalid_argument&) {
        return std::nullopt;
    }
}

Quantity inMetres(Quantity quantity, double spacing) {
    if (!quantity.inSpacings) return quantity;
    return {quantity.value * spacing, unit::metre, true, false};
}

bool areSame(const Node& before, const Node& now, const Spacings& spacings) {
    if (before.kind != now.kind) return false;
    if (before.kind == Node::Kind::list)
        return std::equal(before.items.begin(), before.items.end(), now.items.begin(), now.items.end(),
                          [&](const Node& a, const Node& b) { return areSame(a, b, spacings); });
    if (before.kind == Node::Kind::table)
        return std::equal(before.entries.begin(), before.entries.end(), now.entries.begin(), now.entries.end(),
                          [&](const Node::Entry& a, const Node::Entry& b) {
                              return a.key == b.key && areSame(a.value, b.value, spacings);
                          });
    const auto was = quantityOf(before), is = quantityOf(now);
    if (!was || !is) return before.scalar == now.scalar;
    const Quantity a = inMetres(*was, spacings.before), b = inMetres(*is, spacings.now);
    return a.dimension == b.dimension &&
           std::abs(a.value - b.value) <= slack * std::max(std::abs(a.value), std::abs(b.value));
}

std::string modelNameOf(const Node& node, const std::string& family) {
    if (node.kind == Node::Kind::scalar) return node.scalar;
    if (const Node* type = node.find("type")) return type->scalar;
    const auto found = families().find(family);
    return found == families().end() ? std::string() : found->second.usual;
}

std::optional<SchemaInfo> settingsOf(const std::string& family, const std::string& name) {
    const auto found = families().find(family);
    if (found == families().end()) return std::nullopt;
    for (const ModelInfo& model : found->second.models())
        if (model.name == name) return model.settings;
    return std::nullopt;
}

const FieldInfo* fieldOf(const SchemaInfo& info, const std::string& key) {
    const FieldInfo* rest = nullptr;
    for (const FieldInfo& f : info.fields) {
        if (f.key == key) return &f;
        if (f.key == "*") rest = &f;
    }
    return rest;
}

// The keys of both, in the order of the second, then those that only the first has.
std::vector<std::string> keysOf(const Node& before, const Node& now) {
    std::vector<std::string> keys;
    for (const Node* node : {&now, &before})
        for (const auto& entry : node->entries)
            if (std::find(keys.begin(), keys.end(), entry.key) == keys.end()) keys.push_back(entry.key);
    return keys;
}

class Comparison {
  public:
    explicit Comparison(Spacings spacings) : spacings_(spacings) {}

    void field(const FieldInfo& info, AtRestart around, const std::string& key, const Node* before, const Node* now) {
        if (!before && !now) return;
        const AtRestart policy = below(around, info);
        const bool areTables = before && now && before->kind == Node::Kind::table && now->kind == Node::Kind::table;
        const bool areLists = before && now && before->kind == Node::Kind::list && now->kind == Node::Kind::list;
        if (info.type == "table" && areTables) {
            table(info.table(), policy, key, *before, *now);
        } else if (info.type == "model" && before && now &&
                   modelNameOf(*before, info.family) == modelNameOf(*now, info.family)) {
            model(info, policy, key, *before, *now);
        } else if (info.type == "list" && areLists) {
            list(info, policy, key, *before, *now);
        } else if ((info.type == "map" || info.type == "models") && areTables) {
            for (const std::string& name : keysOf(*before, *now))
                field(itemOf(info), policy, joined(key, name), before->find(name), now->find(name));
        } else if (!before || !now || !areSame(*before, *now, spacings_)) {
            add(policy, key, before, now);
        }
    }
    std::vector<SettingChange> changes;

  private:
    // One value of a list, a map or a table of models.
    static FieldInfo itemOf(FieldInfo info) {
        info.type = info.type == "models" ? "model" : "table";
        info.atRestart = AtRestart::undeclared;
        return info;
    }
    void table(const SchemaInfo& info, AtRestart policy, const std::string& path, const Node& before, const Node& now,
               const std::string& ignored = {}) {
        for (const std::string& key : keysOf(before, now)) {
            if (key == ignored) continue;
            const FieldInfo* found = fieldOf(info, key);
            // A key that is not declared is from another version; the policy of the table around it applies.
            FieldInfo one = found ? *found : FieldInfo{};
            if (one.key == "*" && (one.type == "map" || one.type == "models")) {
                const AtRestart own = one.atRestart;
                one = itemOf(one);
                one.atRestart = own;
            }
            field(one, policy, joined(path, key), before.find(key), now.find(key));
        }
    }
    void model(const FieldInfo& info, AtRestart policy, const std::string& key, const Node& before, const Node& now) {
        const std::optional<SchemaInfo> settings = settingsOf(info.family, modelNameOf(now, info.family));
        static const Node empty;
        const auto asTable = [&](const Node& node) -> const Node& {
            return node.kind == Node::Kind::table ? node : empty;
        };
        table(settings.value_or(SchemaInfo{}), policy, key, asTable(before), asTable(now), "type");
    }
    void list(const FieldInfo& info, AtRestart policy, const std::string& key, const Node& before, const Node& now) {
        for (std::size_t i = 0; i < std::max(before.items.size(), now.items.size()); ++i)
            field(itemOf(info), policy, fmt::format("{}[{}]", key, i),
                  i < before.items.size() ? &before.items[i] : nullptr, i < now.items.size() ? &now.items[i] : nullptr);
    }
    void add(AtRestart policy, const std::string& key, const Node* before, const Node* now) {
        changes.push_back(
            {key, effective(policy), before ? shownValue(*before) : "nothing", now ? shownValue(*now) : "nothing"});
    }

    Spacings spacings_;
};

// Every field with its key and policy, those of all models included.
using Visitor = std::function<void(const FieldInfo& field, const std::string& key, AtRestart policy)>;
void walk(const FieldInfo& info, AtRestart around, const std::string& key, const Visitor& visit) {
    const AtRestart policy = below(around, info);
    visit(info, key, policy);
    const auto ofTable = [&](const SchemaInfo& table, const std::string& path) {
        for (const FieldInfo& f : table.fields) walk(f, policy, joined(path, f.key == "*" ? "<name>" : f.key), visit);
    };
    if (info.table) {
        const bool isNamed = info.type == "map" && info.key != "*";
        ofTable(info.table(), info.type == "list" ? key + "[]" : isNamed ? key + ".<name>" : key);
    } else if (const auto family = families().find(info.family); family != families().end()) {
        for (const ModelInfo& model : family->second.models()) ofTable(model.settings, joined(key, model.name));
    }
}

}  // namespace

FieldInfo dictionaryField(std::function<SchemaInfo()> table) {
    FieldInfo info;
    info.type = "table";
    info.table = std::move(table);
    return info;
}

FieldInfo dictionaryField(const std::string& family) {
    FieldInfo info;
    info.type = "model";
    info.family = family;
    return info;
}

std::vector<SettingChange> settingChanges(const FieldInfo& dictionary, const Node& before, const Node& now,
                                          Spacings spacings) {
    Comparison comparison(spacings);
    comparison.field(dictionary, AtRestart::undeclared, "", &before, &now);
    return std::move(comparison.changes);
}

std::vector<DeclaredSetting> declaredSettings(const FieldInfo& dictionary) {
    std::vector<DeclaredSetting> settings;
    walk(dictionary, AtRestart::undeclared, "", [&](const FieldInfo& field, const std::string& key, AtRestart policy) {
        if (!field.table && !key.empty()) settings.push_back({key, policy});
    });
    return settings;
}

std::string restartPage(const std::vector<std::pair<std::string, FieldInfo>>& dictionaries) {
    std::string text =
        "## At a restart\n\n"
        "What a setting that has changed since the checkpoint means to a run that continues from it. The settings "
        "below one "
        "that is listed go with it, unless they are listed themselves; fixed is what is not listed at all.\n\n"
        "| | a changed value |\n|---|---|\n"
        "| fixed | is refused: the state of the checkpoint depends on it |\n"
        "| noted | holds from the restart on; the log says both values |\n"
        "| free | holds from the restart on |\n"
        "| resolved | acts through a value that follows from it and from other settings (density from Re, viscosity "
        "that "
        "particles carry, integrators of another state), which is fixed |\n\n"
        "| file | setting | at a restart |\n|---|---|---|\n";
    for (const auto& [file, dictionary] : dictionaries) {
        const std::string& name = file;
        walk(dictionary, AtRestart::undeclared, "",
             [&](const FieldInfo& field, const std::string& key, AtRestart policy) {
                 if (field.atRestart != AtRestart::undeclared)
                     text += fmt::format("| {} | `{}` | {} |\n", name, key, nameOf(policy));
             });
    }
    return text;
}

// Only the top level is searched: free settings are declared as a whole, at the top of a dictionary.
Node withoutFree(const FieldInfo& dictionary, const Node& settings) {
    Node kept = settings;
    const std::optional<SchemaInfo> info =
        dictionary.table ? dictionary.table() : settingsOf(dictionary.family, modelNameOf(settings, dictionary.family));
    if (!info) return kept;
    std::erase_if(kept.entries, [&](const Node::Entry& entry) {
        const FieldInfo* field = fieldOf(*info, entry.key);
        return field && field->atRestart == AtRestart::free;
    });
    return kept;
}

std::string shownValue(const Node& value) {
    std::vector<std::string> parts;
    if (value.kind == Node::Kind::list) {
        for (const Node& item : value.items) parts.push_back(shownValue(item));
        return fmt::format("[{}]", joinWords(parts));
    }
    if (value.kind == Node::Kind::table) {
        for (const auto& [key, item] : value.entries) parts.push_back(fmt::format("{}: {}", key, shownValue(item)));
        return fmt::format("{{{}}}", joinWords(parts));
    }
    const std::optional<Quantity> quantity = quantityOf(value);
    if (!quantity || quantity->inSpacings || quantity->dimension.isDimensionless()) return value.scalar;
    return formatQuantity(quantity->value, quantity->dimension, 6);
}

}  // namespace corpuscle
