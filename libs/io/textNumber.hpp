// Numbers in text files, independent of the locale.
#pragma once
#include <charconv>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

namespace corpuscle::io {

// The whole word as a number ("1", "+2.5e-3", "nan", "inf"), or nothing. A value too small for a double is 0, one too
// large is infinite.
inline std::optional<double> textToDouble(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    if (word.starts_with('+') || word.empty()) return std::nullopt;
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc::invalid_argument || end != word.data() + word.size()) return std::nullopt;
    if (error == std::errc::result_out_of_range) return std::strtod(std::string(word).c_str(), nullptr);
    return value;
}

template <class Integer>
std::optional<Integer> textToInteger(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    Integer value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

}  // namespace corpuscle::io
