// The text of a dictionary before it is parsed as YAML: finds what is not the text of a dictionary at all, and habits
// from other formats.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace corpuscle {

inline constexpr std::size_t largestDictionary = 4 << 20;  // [bytes]
// Levels of nesting, so that recursion over nodes stays far from a stack overflow.
inline constexpr std::size_t deepestDictionary = 64;

struct Opened {
    char character;    // a bracket or a quotation mark
    int line, column;  // from 0
};

// "[20, 16, 16] um" is not YAML. The unit is replaced by blanks before parsing, so that every column stays right, and
// is stored under the place of its bracket: the reader then shows how to write it.
struct DictionaryText {
    std::string text;
    std::map<std::pair<int, int>, std::string> unitAt;  // (line, column) of '[', from 0, in bytes as yaml-cpp counts
    std::optional<Opened> unclosed;                     // the bracket to report if YAML cannot read the text
};

// The text without byte-order mark and with lines ended by \n. What cannot be part of a dictionary is added to
// `problems`: another encoding, bytes that are not text, a file that is too large, tabs, unclosed quotation marks,
// directives of other programs.
DictionaryText dictionaryText(std::string text, const std::string& shownAs, Problems& problems);

std::string tooLarge(std::size_t bytes);  // the message for a file above largestDictionary
std::string tooDeep();                    // the message for more levels than deepestDictionary

// A habit from another format that makes this text unreadable as YAML: a missing blank after ':', '=' for ':', a final
// ';', comments with '//'. Searched in `line` (from 1), the two lines before it and the one after it; in all lines if
// `line` is 0.
std::optional<Problem> foreignHabit(const std::string& text, const std::string& shownAs, int line);

}  // namespace corpuscle
