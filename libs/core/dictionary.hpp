// One YAML file of a case, read strictly.
//
// The subset of YAML: no anchors, aliases, tags, merges or tabs; duplicate keys are errors; every scalar is kept as
// text, so that "012" and "no" stay as written. UTF-8, with or without a byte-order mark, lines ended by \n or \r\n, at
// most 4 MiB, nested at most 64 levels deep; the time to read a file is proportional to its size. A Node knows its
// place (file:line:column) and its full key. Overrides (-set) are applied before any setting is read, and have the
// place "-set".
#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

class Node {
  public:
    enum class Kind { scalar, list, table };

    Kind kind = Kind::table;
    Mark mark;           // of the value
    Mark keyMark;        // of the key that holds it
    std::string path;    // "cells[0].shape.d"; empty for the whole file
    std::string scalar;  // kind scalar: the text as written (quotes removed)
    bool quoted = false;
    std::vector<Node> items;  // kind list
    std::string unit;  // kind list: text found after it, as in "[20, 16, 16] um"; not YAML, every reader rejects it
    struct Entry;      // a key and its value
    std::vector<Entry> entries;  // kind table, in the order of the file

    Node();
    Node(const Node&);
    Node(Node&&) noexcept;
    Node& operator=(const Node&);
    Node& operator=(Node&&) noexcept;
    ~Node();

    const Node* find(std::string_view key) const;
    Node* find(std::string_view key);
    bool isNothing() const { return kind == Kind::scalar && !quoted && scalar.empty(); }  // "key:" without a value
    std::string kindText() const;  // "a table", "a list of 3", "the word 'tait'", "the number 3" for messages
    // Place of the key, or of the value if it has no key.
    const Mark& place() const { return keyMark.file.empty() ? mark : keyMark; }
    void setPath(const std::string& newPath);  // of this node and all below it

    static Node word(std::string text);
    static Node list(const std::vector<std::string>& words);
};

struct Node::Entry {
    std::string key;
    Node value;
    Entry(std::string k, Node v) : key(std::move(k)), value(std::move(v)) {}
};

bool isName(const std::string& text);  // [A-Za-z][A-Za-z0-9_-]*

// Reads and checks the form of one file. Faults of form go to `problems`; the returned node then holds what could be
// read. A file that does not exist is a problem too, whose message names a tutorial that has one.
Node readDictionary(const std::filesystem::path& file, const std::string& shownAs, Problems& problems);

// Parses from memory: a whole file, whose root is a table, or one value of any kind.
Node parseDictionary(const std::string& text, const std::string& shownAs, Problems& problems);
Node parseValue(const std::string& text, const std::string& shownAs, Problems& problems);

// One -set FILE:/path/to/key=value. The value is YAML ("16 um", "[1, 2, 3]", "{type: lucy}"); list items are given by
// number ("cells/0/edge"). A key that the file lacks is added (the reader then says whether it is known).
struct Override {
    std::string file;  // "system/control.yaml"
    std::string path;  // "/write/strain"
    std::string value;
};
Override parseOverride(const std::string& text);  // throws Failure(usage)
void applyOverride(Node& root, const Override& change, Problems& problems);

// YAML text of a node; parsing it gives the same node.
std::string emit(const Node& node);
std::string emitInLine(const Node& node);  // on one line: lists and tables in brackets, no newline at the end

}  // namespace corpuscle
