#include "core/dictionaryText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <regex>
#include <sstream>
#include <string_view>

namespace corpuscle {
namespace {

constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";

bool isUtf16(const std::string& text) {
    const std::string_view start = std::string_view(text).substr(0, 2);
    if (start == "\xFF\xFE" || start == "\xFE\xFF") return true;
    // Without a mark: every second byte of the beginning is zero.
    const std::size_t n = std::min<std::size_t>(text.size(), 64) / 2 * 2;
    std::size_t zeros[2] = {0, 0};
    for (std::size_t i = 0; i < n; ++i) zeros[i % 2] += text[i] == '\0';
    return n >= 4 && (zeros[0] == n / 2) != (zeros[1] == n / 2);
}

// Length of the UTF-8 character that starts at i; 0 where there is none.
std::size_t characterAt(const std::string& text, std::size_t i) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    const unsigned char first = byte(i);
    const std::size_t length = first < 0x80                    ? 1
                               : first >= 0xC2 && first < 0xE0 ? 2
                               : first >= 0xE0 && first < 0xF0 ? 3
                               : first >= 0xF0 && first < 0xF5 ? 4
                                                               : 0;
    if (length == 0 || i + length > text.size()) return 0;
    for (std::size_t k = 1; k < length; ++k)
        if ((byte(i + k) & 0xC0) != 0x80) return 0;
    return length;
}

void endLinesWithNewline(std::string& text) {
    std::size_t out = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n') continue;
        text[out++] = text[i] == '\r' ? '\n' : text[i];
    }
    text.resize(out);
}

// Reports the first byte that cannot be in a text file; false when there is one.
bool isText(const std::string& text, const std::string& shownAs, Problems& problems) {
    int line = 1;
    std::size_t lineStart = 0;
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const std::size_t length = characterAt(text, i);
        const Mark here{shownAs, line, static_cast<int>(i - lineStart) + 1};
        if (length == 0) {
            problems.add(here, "", fmt::format("byte 0x{:02X} is not UTF-8; save the file as UTF-8 text", byte));
            return false;
        }
        if ((byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7F) {
            problems.add(here, "",
                         fmt::format("control character 0x{:02X}; this is not a text file, or it is damaged", byte));
            return false;
        }
        if (byte == '\n') {
            ++line;
            lineStart = i + 1;
        }
        i += length;
    }
    return true;
}

// "#include" is a comment in YAML: what it should include would be missing without a message.
void refuseDirectives(const std::string& text, const std::string& shownAs, Problems& problems) {
    int line = 1;
    for (std::size_t begin = 0; begin < text.size(); ++line) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view all = std::string_view(text).substr(begin, end - begin);
        const std::size_t column = std::min(all.find_first_not_of(' '), all.size());
        const std::string_view rest = all.substr(column);
        for (const std::string_view word :
             {"#includeEtc", "#includeIfPresent", "#include", "#calc", "#inputMode", "#remove"})
            if (rest.starts_with(word) &&
                (rest.size() == word.size() || rest[word.size()] == ' ' || rest[word.size()] == '"')) {
                problems.add(
                    {shownAs, line, static_cast<int>(column) + 1}, "",
                    fmt::format("'{}' has no effect: a line that starts with '#' is a comment. Write the keys out here",
                                word));
                break;
            }
        begin = end + 1;
    }
}

}  // namespace

std::string tooLarge(std::size_t bytes) {
    return fmt::format(
        "the file has {:.1f} MB; a dictionary has at most {:.0f} MB. Is it another file under this name?",
        1e-6 * static_cast<double>(bytes), 1e-6 * static_cast<double>(largestDictionary));
}

std::string tooDeep() {
    return fmt::format("nested more than {} levels deep; no dictionary needs that", deepestDictionary);
}

namespace {

// Scans a text once, following only its brackets, quotations and comments.
class Scanner {
  public:
    Scanner(std::string& text, const std::string& shownAs, DictionaryText& result, Problems& problems)
        : text_(text), shownAs_(shownAs), result_(result), problems_(problems) {}

    // False when the text must not be parsed any further.
    bool run() {
        for (i_ = 0; i_ < text_.size(); ++i_)
            if (!take(text_[i_])) return false;
        if (quote_)
            problems_.add({shownAs_, quotation_.line + 1, quotation_.column + 1}, "",
                          fmt::format("this quotation mark is not closed; a {} is missing", quote_));
        if (!open_.empty() && !result_.unclosed) result_.unclosed = open_.front();
        return true;
    }

  private:
    bool take(char c) {
        if (c == '\n') {
            ++line_;
            column_ = 0;
            previous_ = '\n';
            return true;
        }
        const int here = column_++;
        if (c == '\t') {
            if (!tabs_++) problems_.add({shownAs_, line_ + 1, here + 1}, "", "a tab; use blanks, two for each level");
            text_[i_] = ' ';
            return true;
        }
        if (quote_) {
            quoted(c);
            return true;
        }
        if (c == '#' && (i_ == 0 || text_[i_ - 1] == ' ' || text_[i_ - 1] == '\n')) {  // a comment
            while (i_ + 1 < text_.size() && text_[i_ + 1] != '\n') ++i_;
            return true;
        }
        const bool startsToken = previous_ == '\n' ||
                                 (text_[i_ - 1] == ' ' && (previous_ == ':' || previous_ == '-')) ||
                                 (!open_.empty() && std::string_view(",[{:").find(previous_) != std::string_view::npos);
        if ((c == '"' || c == '\'') && startsToken) {
            quote_ = c;
            quotation_ = {c, line_, here};
        }
        if ((c == '[' || c == '{') && (startsToken || !open_.empty())) {
            open_.push_back({c, line_, here});
            if (open_.size() > deepestDictionary) {
                problems_.add({shownAs_, line_ + 1, here + 1}, "", tooDeep());
                return false;
            }
        }
        if ((c == ']' || c == '}') && !open_.empty()) close(c);
        if (c != ' ' && c != '\r') previous_ = c;
        return true;
    }

    void quoted(char c) {
        if (c == '\\' && quote_ == '"' && i_ + 1 < text_.size() && text_[i_ + 1] != '\n') {
            ++i_;
            ++column_;
        } else if (c == quote_) {
            quote_ = 0;
        }
        previous_ = c;
    }

    // Closes a bracket. What follows a list as its unit is stored in unitAt and replaced by blanks.
    void close(char c) {
        const Opened opened = open_.back();
        open_.pop_back();
        if ((opened.character == '[') != (c == ']') && !result_.unclosed) result_.unclosed = opened;
        std::size_t end = i_ + 1;
        while (end < text_.size() && std::string_view(",]}\n").find(text_[end]) == std::string_view::npos &&
               !(text_[end] == '#' && text_[end - 1] == ' '))
            ++end;
        std::string unit = text_.substr(i_ + 1, end - i_ - 1);
        unit.erase(0, unit.find_first_not_of(' '));
        unit.erase(unit.find_last_not_of(" \r") + 1);
        if (opened.character == '[' && c == ']' && !unit.empty() && unit.front() != ':') {
            result_.unitAt[{opened.line, opened.column}] = unit;
            std::fill(text_.begin() + static_cast<long>(i_) + 1, text_.begin() + static_cast<long>(end), ' ');
        }
    }

    std::string& text_;
    const std::string& shownAs_;
    DictionaryText& result_;
    Problems& problems_;
    std::size_t i_ = 0;
    std::vector<Opened> open_;
    Opened quotation_{};
    std::size_t tabs_ = 0;  // only the first is reported
    int line_ = 0, column_ = 0;
    char quote_ = 0, previous_ = '\n';  // previous: last character of this line that is not blank
};

}  // namespace

DictionaryText dictionaryText(std::string text, const std::string& shownAs, Problems& problems) {
    DictionaryText result;
    if (text.size() > largestDictionary) {
        problems.add({shownAs, 0, 0}, "", tooLarge(text.size()));
        return result;
    }
    if (isUtf16(text)) {
        problems.add({shownAs, 0, 0}, "", "the file is in UTF-16; save it as UTF-8 text");
        return result;
    }
    if (text.starts_with(byteOrderMark)) text.erase(0, byteOrderMark.size());
    endLinesWithNewline(text);
    if (!isText(text, shownAs, problems)) return result;
    refuseDirectives(text, shownAs, problems);
    if (Scanner(text, shownAs, result, problems).run()) result.text = std::move(text);
    return result;
}

std::optional<Problem> foreignHabit(const std::string& text, const std::string& shownAs, int line) {
    static const std::regex comment(" *(//|/\\*).*"), ending("[^#]*; *"), noBlank(" *(?:- )?([A-Za-z]\\w*):([^ ].*)"),
        equals(" *(?:- )?([A-Za-z]\\w*) *= *(.*)"), braces(" *([A-Za-z]\\w*)? *\\{? *"),
        braced(" *(?:- )?([A-Za-z]\\w*) *\\{(.*)\\} *;? *");
    constexpr std::size_t longest = 200;
    constexpr int before = 2, after = 1;  // lines
    std::istringstream lines(text);
    std::string now, last;
    for (int n = 1; std::getline(lines, now) && (line == 0 || n <= line + after); ++n) {
        if (now.size() > longest || now.find_first_not_of(' ') == std::string::npos ||
            now[now.find_first_not_of(' ')] == '#')
            continue;
        if (line == 0 || n + before >= line) {
            std::smatch part;
            const int column = static_cast<int>(now.find_first_not_of(' ')) + 1;
            const auto found = [&](const std::string& message) { return Problem{{shownAs, n, column}, "", message}; };
            if (std::regex_match(now, part, comment))
                return found(fmt::format("a comment starts with '#', not with '{}'", part[1].str()));
            if (std::regex_match(now, part, braced))
                return found(
                    fmt::format("a table on one line is written '{}: {{key: value, key: value}}': a ':' after each "
                                "name, and ',' between the entries",
                                part[1].str()));
            if (std::regex_match(now, ending)) return found("lines do not end with ';' here: write 'key: value'");
            if (std::regex_match(now, part, equals))
                return found(fmt::format("'=' in place of ':': write '{}: {}'", part[1].str(), part[2].str()));
            if (std::regex_match(now, part, noBlank) && !part[2].str().starts_with("//"))
                return found(
                    fmt::format("a blank is missing after the ':': write '{}: {}'", part[1].str(), part[2].str()));
            if (now.substr(static_cast<std::size_t>(column) - 1) == "{" && std::regex_match(last, part, braces) &&
                part[1].matched)
                return found(
                    fmt::format("a table starts with a ':' after its name: write '{}:', and its keys below, indented "
                                "by two blanks, without braces",
                                part[1].str()));
        }
        last = now;
    }
    return std::nullopt;
}

}  // namespace corpuscle
