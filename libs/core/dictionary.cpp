#include "core/dictionary.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>
#include <unordered_map>

#include "core/dictionaryText.hpp"

namespace corpuscle {

Node::Node() = default;
Node::Node(const Node&) = default;
Node::Node(Node&&) noexcept = default;
Node& Node::operator=(const Node&) = default;
Node& Node::operator=(Node&&) noexcept = default;
Node::~Node() = default;

const Node* Node::find(std::string_view key) const {
    for (const auto& [name, node] : entries)
        if (name == key) return &node;
    return nullptr;
}

Node* Node::find(std::string_view key) { return const_cast<Node*>(std::as_const(*this).find(key)); }

std::string Node::kindText() const {
    if (kind == Kind::table) return "a table";
    if (kind == Kind::list) return fmt::format("a list of {}", items.size());
    if (isNothing()) return "nothing";
    double number = 0;
    const auto [end, error] = std::from_chars(scalar.data(), scalar.data() + scalar.size(), number);
    const bool isNumber = error == std::errc() && end == scalar.data() + scalar.size();
    return fmt::format("the {} '{}'", isNumber ? "number" : isName(scalar) ? "word" : "text", shortened(scalar, 80));
}

void Node::setPath(const std::string& newPath) {
    path = newPath;
    for (std::size_t i = 0; i < items.size(); ++i) items[i].setPath(fmt::format("{}[{}]", path, i));
    for (auto& [key, node] : entries) node.setPath(path.empty() ? key : path + "." + key);
}

Node Node::word(std::string text) {
    Node node;
    node.kind = Kind::scalar;
    node.scalar = std::move(text);
    return node;
}

Node Node::list(const std::vector<std::string>& words) {
    Node node;
    node.kind = Kind::list;
    for (const std::string& w : words) node.items.push_back(word(w));
    return node;
}

bool isName(const std::string& text) {
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    if (text.empty() || !letter(text[0])) return false;
    for (char c : text)
        if (!letter(c) && !(c >= '0' && c <= '9') && c != '_' && c != '-') return false;
    return true;
}

namespace {

struct TooDeep {
    Mark mark;
};

class TreeBuilder : public YAML::EventHandler {
  public:
    TreeBuilder(const std::string& shownAs, const DictionaryText& units, Problems& problems)
        : shownAs_(shownAs), units_(units), problems_(problems) {}

    bool hasRoot() const { return hasRoot_; }
    Node root() { return std::move(root_); }

    void OnDocumentStart(const YAML::Mark&) override {}
    void OnDocumentEnd() override {}
    void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
        refuse(mark, "", anchor);
        put(scalarNode(mark, "", false));
    }
    void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
        problems_.add(place(mark), "",
                      "an alias (*name); write the value out, anchors and aliases are not part of a dictionary");
        put(scalarNode(mark, "", false));
    }
    void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  const std::string& value) override {
        refuse(mark, tag, anchor);
        put(scalarNode(mark, value, tag == "!"));
    }
    void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                         YAML::EmitterStyle::value) override {
        refuse(mark, tag, anchor);
        Node node;
        node.kind = Node::Kind::list;
        node.mark = place(mark);
        if (const auto unit = units_.unitAt.find({mark.line, mark.column}); unit != units_.unitAt.end())
            node.unit = unit->second;
        open(std::move(node));
    }
    void OnSequenceEnd() override { close(); }
    void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                    YAML::EmitterStyle::value) override {
        refuse(mark, tag, anchor);
        Node node;
        node.mark = place(mark);
        open(std::move(node));
    }
    void OnMapEnd() override { close(); }

  private:
    struct Level {
        Node node;
        std::string key{};
        Mark keyMark{};
        bool hasKey = false;
        std::unordered_map<std::string, int> lineOf{};  // of the keys so far
    };

    void open(Node node) {
        if (open_.size() == deepestDictionary) throw TooDeep{node.mark};
        open_.push_back({.node = std::move(node)});
    }

    Mark place(const YAML::Mark& mark) const { return {shownAs_, mark.line + 1, mark.column + 1}; }

    Node scalarNode(const YAML::Mark& mark, const std::string& value, bool quoted) const {
        Node node = Node::word(value);
        node.mark = place(mark);
        node.quoted = quoted;
        return node;
    }

    void refuse(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
        if (anchor) problems_.add(place(mark), "", "an anchor (&name); write the value out where it is needed");
        if (!tag.empty() && tag != "?" && tag != "!")
            problems_.add(place(mark), "", fmt::format("a tag ({}); values carry no tags in a dictionary", tag));
    }

    void close() {
        Node node = std::move(open_.back().node);
        open_.pop_back();
        put(std::move(node));
    }

    void put(Node node) {
        if (open_.empty()) {
            root_ = std::move(node);
            hasRoot_ = true;
            return;
        }
        Level& level = open_.back();
        if (level.node.kind == Node::Kind::list) {
            level.node.items.push_back(std::move(node));
        } else if (!level.hasKey) {
            level.hasKey = true;
            level.key = node.scalar;
            level.keyMark = node.mark;
            if (node.kind != Node::Kind::scalar)
                problems_.add(node.mark, "", fmt::format("{} as a key; a key is one word", node.kindText()));
            else if (node.scalar == "<<")
                problems_.add(node.mark, "", "a merge ('<<'); write the keys out");
            else if (node.isNothing())
                problems_.add(node.mark, "", "a value without a key");
        } else {
            level.hasKey = false;
            node.keyMark = level.keyMark;
            const auto [earlier, isNew] = level.lineOf.emplace(level.key, node.keyMark.line);
            if (!isNew) {
                problems_.add(level.keyMark, level.key,
                              fmt::format("this key stands twice, first in line {}; keep one", earlier->second));
            } else {
                if (const std::size_t colon = level.key.find(':'); node.isNothing() && colon != std::string::npos)
                    problems_.add(level.keyMark, "",
                                  fmt::format("a blank is missing after the ':': write '{}: {}'",
                                              level.key.substr(0, colon), level.key.substr(colon + 1)));
                level.node.entries.emplace_back(level.key, std::move(node));
            }
        }
    }

    std::string shownAs_;
    const DictionaryText& units_;
    Problems& problems_;
    std::vector<Level> open_;
    Node root_;
    bool hasRoot_ = false;
};

// Message about a value that YAML cannot read.
std::string hint(const std::string& message) {
    if (message.find("anchor is not defined") != std::string::npos)
        return "an alias (*name); write the value out, anchors and aliases are not part of a dictionary";
    const auto has = [&](const char* part) { return message.find(part) != std::string::npos; };
    if (has("end of map") || has("end of sequence not found") || has("illegal map value"))
        return message + "; is a ':' missing, or a line indented wrongly?";
    return message;
}

Node parse(const std::string& text, const std::string& shownAs, bool tableOnly, Problems& problems) {
    const std::size_t before = problems.count();
    const DictionaryText units = dictionaryText(text, shownAs, problems);
    Node root;
    root.mark = {shownAs, 1, 1};
    if (problems.count() != before) return root;  // YAML would report the same place once more
    // A habit from another format, if there is one, explains more than YAML's message. `line` counts from 1; 0: all
    // lines.
    const auto complain = [&](const Mark& mark, const std::string& message, int line) {
        if (const auto habit = foreignHabit(units.text, shownAs, line))
            problems.add(habit->mark, "", habit->message);
        else
            problems.add(mark, "", message);
    };
    try {
        std::istringstream stream(units.text);
        YAML::Parser parser(stream);
        TreeBuilder tree(shownAs, units, problems);
        if (parser.HandleNextDocument(tree) && tree.hasRoot()) {
            Node read = tree.root();
            if (tableOnly && read.kind != Node::Kind::table && !read.isNothing())
                complain(read.mark,
                         fmt::format("found {}; a dictionary is a table of 'key: value' lines", read.kindText()), 0);
            else if (!(tableOnly && read.isNothing()))
                root = std::move(read);
            TreeBuilder second(shownAs, units, problems);
            if (problems.count() == before && parser.HandleNextDocument(second))
                problems.add(root.mark, "", "more than one document ('---'); one file holds one dictionary");
        }
    } catch (const TooDeep& there) {
        problems.add(there.mark, "", tooDeep());
    } catch (const YAML::Exception& e) {
        if (const auto& opened = units.unclosed)
            problems.add({shownAs, opened->line + 1, opened->column + 1}, "",
                         fmt::format("this '{}' is not closed; a '{}' is missing", opened->character,
                                     opened->character == '[' ? ']' : '}'));
        else
            complain({shownAs, e.mark.line + 1, e.mark.column + 1}, hint(e.msg), e.mark.line + 1);
    }
    root.setPath("");
    return root;
}

}  // namespace

Node parseDictionary(const std::string& text, const std::string& shownAs, Problems& problems) {
    return parse(text, shownAs, true, problems);
}

Node parseValue(const std::string& text, const std::string& shownAs, Problems& problems) {
    return parse(text, shownAs, false, problems);
}

Node readDictionary(const std::filesystem::path& file, const std::string& shownAs, Problems& problems) {
    std::ifstream stream(file);
    std::ostringstream text;
    if (stream && !std::filesystem::is_directory(file))
        text << stream.rdbuf();
    else
        problems.add({shownAs, 0, 0}, "",
                     fmt::format("there is no such file ({}). Is -case right? A tutorial's {} is a good start",
                                 file.string(), shownAs));
    return parseDictionary(text.str(), shownAs, problems);
}

Override parseOverride(const std::string& text) {
    const std::size_t colon = text.find(":/"), equals = text.find('=', colon == std::string::npos ? 0 : colon);
    if (colon == std::string::npos || colon == 0 || equals == std::string::npos || equals == colon + 2)
        throw Failure(ExitCode::usage, fmt::format("-set {}: expected FILE:/path/to/key=value, for example "
                                                   "-set system/mesh.yaml:/cells/0/edge='0.4 um'",
                                                   text));
    return {text.substr(0, colon), text.substr(colon + 1, equals - colon - 1), text.substr(equals + 1)};
}

namespace {

void markAsSet(Node& node) {
    node.mark = node.keyMark = {"-set", 0, 0};
    for (Node& item : node.items) markAsSet(item);
    for (auto& [key, child] : node.entries) markAsSet(child);
}

Node* child(Node& node, const std::string& name, const std::string& shown, Problems& problems) {
    const auto complain = [&](const std::string& message) {
        problems.add({"-set", 0, 0}, shown, message);
        return nullptr;
    };
    if (name.empty()) return complain("an empty name between two '/'");
    if (node.kind == Node::Kind::list) {
        std::size_t i = 0;
        const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), i);
        if (error != std::errc() || end != name.data() + name.size() || i >= node.items.size())
            return complain(fmt::format("'{}' is not an item of this list; it has the items 0 to {}", name,
                                        static_cast<long>(node.items.size()) - 1));
        return &node.items[i];
    }
    if (node.kind == Node::Kind::scalar) {
        // "kernel: lucy" is short for "kernel: {type: lucy}".
        Node table;
        table.mark = table.keyMark = Mark{"-set", 0, 0};
        if (!node.isNothing()) {
            Node type = node;
            type.keyMark = node.mark;
            table.entries.emplace_back("type", std::move(type));
        }
        node = std::move(table);
    }
    if (Node* found = node.find(name)) return found;
    Node added;
    markAsSet(added);
    return &node.entries.emplace_back(name, std::move(added)).value;
}

}  // namespace

void applyOverride(Node& root, const Override& change, Problems& problems) {
    const std::string shown = change.file + ":" + change.path;
    Problems own;
    Node value = parseValue(change.value, "-set " + shown, own);
    if (!own.empty()) {
        problems.add({"-set", 0, 0}, shown, fmt::format("cannot read the value '{}'", change.value));
        return;
    }
    markAsSet(value);
    Node* at = &root;
    std::istringstream path(change.path.substr(1));
    for (std::string name; std::getline(path, name, '/');)
        if (!(at = child(*at, name, shown, problems))) return;
    *at = std::move(value);
    root.setPath("");
}

namespace {

std::string scalarText(const Node& node, bool inFlow) {
    const std::string& s = node.scalar;
    bool plain = !s.empty() && !node.quoted && s.front() != ' ' && s.back() != ' ' && s.back() != ':' &&
                 std::string_view("-?:,[]{}#&*!|>'\"%@`").find(s.front()) == std::string_view::npos &&
                 s.find(": ") == std::string::npos && s.find(" #") == std::string::npos && s != "~" && s != "null";
    // "-3 um" starts with a dash and is plain all the same.
    if (s.size() > 1 && (s.front() == '-' || s.front() == '.') && s[1] >= '0' && s[1] <= '9') plain = !node.quoted;
    for (char c : s)
        if (static_cast<unsigned char>(c) < 0x20 ||
            (inFlow && std::string_view(",[]{}").find(c) != std::string_view::npos))
            plain = false;
    if (plain || node.isNothing()) return s;
    std::string text = "\"";
    for (char c : s) {
        if (c == '"' || c == '\\') text += '\\';
        if (c == '\n')
            text += "\\n";
        else
            text += c;
    }
    return text + '"';
}

std::string flowText(const Node& node) {
    std::string text;
    if (node.kind == Node::Kind::scalar) return scalarText(node, true);
    if (node.kind == Node::Kind::list) {
        for (const Node& item : node.items) text += (text.empty() ? "" : ", ") + flowText(item);
        return "[" + text + "]";
    }
    for (const auto& [key, value] : node.entries)
        text += (text.empty() ? "" : ", ") + scalarText(Node::word(key), true) + ": " + flowText(value);
    return "{" + text + "}";
}

bool inOneLine(const Node& node) {
    if (node.kind == Node::Kind::scalar) return true;
    if (node.kind == Node::Kind::table) return node.entries.empty();
    for (const Node& item : node.items)
        if (item.kind == Node::Kind::table) return false;
    return true;
}

void emitTo(std::string& out, const Node& node, std::size_t indent) {
    const std::string blanks(indent, ' ');
    for (const auto& [key, value] : node.entries) {
        out += blanks + scalarText(Node::word(key), false) + ":";
        if (inOneLine(value)) {
            const std::string text = value.kind == Node::Kind::scalar ? scalarText(value, false) : flowText(value);
            out += (text.empty() ? "" : " " + text) + "\n";
        } else {
            out += "\n";
            emitTo(out, value, indent + 2);
        }
    }
    for (const Node& item : node.items) out += blanks + "- " + flowText(item) + "\n";
}

}  // namespace

std::string emit(const Node& node) {
    if (inOneLine(node)) return (node.kind == Node::Kind::scalar ? scalarText(node, false) : flowText(node)) + "\n";
    std::string text;
    emitTo(text, node, 0);
    return text;
}

std::string emitInLine(const Node& node) { return flowText(node); }

}  // namespace corpuscle
