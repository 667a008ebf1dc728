// Changes of single entries in the text of a dictionary. Everything else stays as it is: comments, layout, order.
//
// A new value takes the place of the old one. An entry that is not there is added at the end of the table that it
// belongs to, in the way that this table is written (in braces, or a line for each key). Of an entry that is taken out,
// the comment on its last line goes with it, and of a table what stands between its lines; other lines of comment stay.
// A list or table in brackets that is replaced takes the comments between its brackets along: change its items one by
// one to keep them.
//
// Each result is read again and compared with the change made on what was read (applyOverride, removeEntry on a Node),
// so that a layout that is not understood is refused and never written wrongly.
#pragma once
#include <string>
#include <vector>

#include "core/dictionary.hpp"

namespace corpuscle {

// The text with the value at change.path. Throws CaseError where the text or the value cannot be read, and
// Failure(invalidCase) where the value cannot be put there; the message names the entry.
std::string withEntry(const std::string& text, const Override& change);

// The text without the entry at `path` ("/write/keep"). Throws as withEntry(), and where there is no such entry.
std::string withoutEntry(const std::string& text, const std::string& file, const std::string& path);

// The node at "/cells/0/edge"; "/" or "" is the root. nullptr where there is none.
const Node* entryAt(const Node& root, const std::string& path);

// As entryAt(), but throws Failure(invalidCase): the key, what stands there, the nearest valid word.
const Node& requiredEntry(const Node& root, const std::string& file, const std::string& path);

// One difference between two dictionaries, by value: the path, and the text of each value, empty where there is none.
struct EntryDifference {
    std::string path, first, second;
};
std::vector<EntryDifference> differences(const Node& first, const Node& second);

}  // namespace corpuscle
