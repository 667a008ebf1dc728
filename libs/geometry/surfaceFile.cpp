#include "geometry/surfaceFile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/textNumber.hpp"

namespace corpuscle::geometry {
namespace {

char lowered(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

// Part of a word for a message: printable and short.
std::string shown(std::string_view word) {
    std::string text;
    for (const char c : word.substr(0, 30)) text += c >= ' ' && c < 127 ? c : '?';
    return word.size() > 30 ? text + "..." : text;
}

}  // namespace

bool equalsIgnoringCase(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lowered(x) == lowered(y); });
}

TextLines::TextLines(std::string_view text, char comment) : text_(text), comment_(comment) {
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
        throw SurfaceFault("the file is text of 16 bits a character (UTF-16); save it as plain text (UTF-8)");
    if (text.starts_with("\xEF\xBB\xBF")) at_ = 3;
}

bool TextLines::next() {
    words_.clear();
    while (at_ < text_.size() && words_.empty()) {
        const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
        line_ = text_.substr(at_, end - at_);
        at_ = end < text_.size() && text_[end] == '\r' && end + 1 < text_.size() && text_[end + 1] == '\n'
                  ? end + 2
                  : std::min(end + 1, text_.size());
        ++number_;
        for (std::size_t i = 0; i < line_.size();) {
            if (isBlank(line_[i])) {
                ++i;
                continue;
            }
            if (comment_ != 0 && line_[i] == comment_) break;
            const std::size_t begin = i;
            while (i < line_.size() && !isBlank(line_[i]) && (comment_ == 0 || line_[i] != comment_)) ++i;
            words_.push_back(line_.substr(begin, i - begin));
        }
    }
    return !words_.empty();
}

void TextLines::fault(const std::string& what) const { throw SurfaceFault(fmt::format("line {}: {}", number_, what)); }

double TextLines::number(std::string_view word) const {
    const auto value = io::textToDouble(word);
    if (value && std::isfinite(*value)) return *value;
    if (value) fault(fmt::format("'{}' is not a finite number", shown(word)));
    if (word.find(',') != std::string_view::npos)
        fault(fmt::format("'{}' has a comma: write decimals with a point, and blanks between numbers", shown(word)));
    fault(fmt::format("'{}' stands where a number is expected", shown(word)));
}

int TextLines::integer(std::string_view word) const {
    const auto value = io::textToInteger<int>(word);
    if (!value) fault(fmt::format("'{}' stands where a whole number is expected", shown(word)));
    return *value;
}

}  // namespace corpuscle::geometry
