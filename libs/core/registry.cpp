#include "core/registry.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace corpuscle {

std::map<std::string, FamilyInfo>& families() {
    static std::map<std::string, FamilyInfo> all;
    return all;
}

std::optional<std::string> modelName(const Node& node, const std::string& family, const std::string& usual,
                                     const std::vector<std::string>& known, Problems& problems) {
    const std::string list = joinWords(known);
    const Node* name = &node;
    if (node.kind == Node::Kind::table) {
        name = node.find("type");
        if (!name && !usual.empty()) return usual;
        if (!name) {
            std::string cure;
            for (const auto& [key, value] : node.entries)
                if (std::find(known.begin(), known.end(), key) != known.end())
                    cure = fmt::format(" Write 'type: {}', with its settings beside it.", key);
            problems.add(node.place(), node.path,
                         fmt::format("'type' is missing: the {} to use.{} Known: {}", family, cure, list));
            return std::nullopt;
        }
    }
    if (name->kind != Node::Kind::scalar || name->isNothing()) {
        problems.add(name->isNothing() ? name->place() : name->mark, name->path,
                     fmt::format("found {}; the name of a {} is expected. Known: {}", name->kindText(), family, list));
        return std::nullopt;
    }
    for (const std::string& k : known)
        if (k == name->scalar) return k;
    problems.add(name->mark, name->path,
                 fmt::format("unknown {} '{}'.{} Known: {}", family, shortened(name->scalar, 80),
                             didYouMean(name->scalar, known), list));
    return std::nullopt;
}

Node modelSettings(const Node& node) {
    if (node.kind == Node::Kind::table) return node;
    Node table;
    table.mark = node.mark;
    table.keyMark = node.keyMark;
    table.path = node.path;
    return table;
}

Node modelNode(const std::string& name, Node settings) {
    if (settings.entries.empty()) return Node::word(name);
    settings.entries.emplace(settings.entries.begin(), "type", Node::word(name));
    return settings;
}

}  // namespace corpuscle
