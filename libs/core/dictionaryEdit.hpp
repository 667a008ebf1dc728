// Changes of single entries in the text of a dictionary. Everything else stays as it is: comments, layout, order.
//
// A new value replaces the old one. A missing entry is added at the end of its table, in the style of that table (in
// braces, or one line for each key). When an entry is removed, the comment on its last line is removed with it, and for
// a table everything between its lines; other comment lines stay. When a list or table in brackets is replaced, the
// comments between its brackets are lost: change its items one by one to keep them.
//
// Each result is parsed again and compared with the same change made on the parsed dictionary (applyOverride,
// removeEntry on a Node), so that a layout that is not understood is rejected and never written wrongly.
#pragma once
#include <string>
#include <vector>

#include "core/dictionary.hpp"

namespace corpuscle {

// The text with change.value at change.path. Throws CaseError where the text or the value cannot be read, and
// Failure(invalidCase) where the value cannot be inserted; the message names the entry.
std::string withEntry(const std::string& text, const Override& change);

// The text without the entry at `path` ("/write/keep"). Throws as withEntry(), and where there is no such entry.
std::string withoutEntry(const std::string& text, const std::string& file, const std::string& path);

// The node at "/cells/0/edge"; "/" or "" is the root. nullptr where there is none.
const Node* entryAt(const Node& root, const std::string& path);

// As entryAt(), but throws Failure(invalidCase) where there is no such node, with the key, what is there instead, and
// the nearest valid word.
const Node& requiredEntry(const Node& root, const std::string& file, const std::string& path);

// One difference in value between two dictionaries: its path, and the text of each value, empty where the entry is
// missing.
struct EntryDifference {
    std::string path, first, second;
};
std::vector<EntryDifference> differences(const Node& first, const Node& second);

}  // namespace corpuscle
