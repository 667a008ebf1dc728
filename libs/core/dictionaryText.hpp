// The text of a dictionary before YAML reads it: what is not such a text at all, and what people write in its place.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace corpuscle {

inline constexpr std::size_t largestDictionary = 4 << 20;  // [bytes]
// Levels: recursion over nodes stays far from the end of the stack.
inline constexpr std::size_t deepestDictionary = 64;

struct Opened {
    char character;    // a bracket or a quotation mark
    int line, column;  // from 0
};

// "[20, 16, 16] um" is not YAML. The unit is replaced by blanks before parsing, so that every column stays right, and
// found again by the place of its bracket: the reader then shows how to write it.
struct DictionaryText {
    std::string text;
    std::map<std::pair<int, int>, std::string> unitAt;  // (line, column) of '[', from 0, in bytes as yaml-cpp counts
    std::optional<Opened> unclosed;                     // the bracket that is to blame if YAML cannot read the text
};

// Without byte-order mark and with lines that end in \n. What cannot be a dictionary goes to `problems`: another
// encoding, bytes that are no text, too many of them, tabs, open quotation marks, directives of other programs.
DictionaryText dictionaryText(std::string text, const std::string& shownAs, Problems& problems);

std::string tooLarge(std::size_t bytes);  // the message for a file above largestDictionary
std::string tooDeep();                    // the message for more levels than deepestDictionary

// The habit of another format that makes this text unreadable as YAML: a missing blank after ':', '=' for ':', a final
// ';', comments with '//'. Looked for in the line (from 1), in the two before and
// in the one after it; in all lines for 0.
std::optional<Problem> foreignHabit(const std::string& text, const std::string& shownAs, int line);

}  // namespace corpuscle
