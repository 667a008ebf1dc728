#include "core/units.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/quantityForms.hpp"

namespace corpuscle {
namespace {

// value in SI = number * 10^decimal * factor. The power of ten is kept separate, so that "8 um" is exactly the double
// 8e-6.
struct UnitValue {
    Dimension dimension;
    int decimal = 0;
    double factor = 1;
};

struct Symbol {
    std::string_view name;
    UnitValue value;
    bool prefixable;
};

constexpr std::array<Symbol, 22> symbols{{{"m", {unit::metre}, true},
                                          {"s", {unit::second}, true},
                                          {"kg", {{1, 0, 0}}, false},
                                          {"g", {{1, 0, 0}, -3}, true},
                                          {"N", {unit::newton}, true},
                                          {"dyn", {unit::newton, -5}, true},
                                          {"Pa", {unit::pascal}, true},
                                          {"bar", {unit::pascal, 5}, true},
                                          {"mmHg", {unit::pascal, 0, 133.322387415}, false},
                                          {"mmH2O", {unit::pascal, 0, 9.80665}, false},
                                          {"cmH2O", {unit::pascal, 0, 98.0665}, false},
                                          {"P", {unit::pascalSecond, -1}, true},
                                          {"J", {unit::joule}, true},
                                          {"erg", {unit::joule, -7}, true},
                                          {"Hz", {unit::perSecond}, true},
                                          {"W", {{1, 2, -3}}, true},
                                          {"L", {{0, 3, 0}, -3}, true},
                                          {"l", {{0, 3, 0}, -3}, true},
                                          {"min", {unit::second, 0, 60}, false},
                                          {"h", {unit::second, 0, 3600}, false},
                                          {"rad", {unit::none}, false},
                                          {"deg", {unit::none, 0, std::numbers::pi / 180}, false}}};

struct Prefix {
    char letter;
    int decimal;
};
constexpr std::array<Prefix, 10> prefixes{
    {{'a', -18}, {'f', -15}, {'p', -12}, {'n', -9}, {'u', -6}, {'m', -3}, {'c', -2}, {'k', 3}, {'M', 6}, {'G', 9}}};

std::string namesOf(bool prefixable) {
    std::vector<std::string> names;
    for (const Symbol& s : symbols)
        if (s.prefixable == prefixable) names.emplace_back(s.name);
    return joinWords(names, " ");
}
std::string prefixLetters() {
    std::vector<std::string> letters;
    letters.reserve(std::size(prefixes));
    for (const Prefix& p : prefixes) letters.emplace_back(1, p.letter);
    return joinWords(letters, " ");
}

std::optional<UnitValue> lookUp(std::string_view name) {
    for (const Symbol& s : symbols)
        if (s.name == name) return s.value;
    for (const Prefix& p : prefixes)
        for (const Symbol& s : symbols)
            if (s.prefixable && name.size() == s.name.size() + 1 && name[0] == p.letter && name.substr(1) == s.name) {
                UnitValue value = s.value;
                value.decimal += p.decimal;
                return value;
            }
    return std::nullopt;
}

const std::vector<std::string>& commonUnits() {
    static const std::vector<std::string> units{"m", "mm", "um", "nm", "s",  "ms",  "us",  "min", "h",   "kg",
                                                "g", "N",  "mN", "uN", "nN", "pN",  "Pa",  "J",   "Hz",  "W",
                                                "L", "uL", "fL", "cm", "ns", "mPa", "kPa", "rad", "deg", "dx"};
    return units;
}

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

UnitValue parseUnit(std::string_view text) {
    UnitValue total;
    std::size_t i = 0;
    int sign = 1;
    bool first = true;
    const auto skipBlanks = [&] {
        while (i < text.size() && text[i] == ' ') ++i;
    };
    while (true) {
        skipBlanks();
        const std::size_t begin = i;
        while (i < text.size() && isLetter(text[i])) ++i;
        if (i > begin && text[i - 1] == 'H' && text.substr(i, 2) == "2O") i += 2;
        const std::string_view name = text.substr(begin, i - begin);
        if (first && name.empty() && i < text.size() && text[i] == '1') {  // "1/s"
            ++i;
        } else if (const auto value = lookUp(name); value) {
            int power = 1;
            if (i < text.size() && text[i] == '^') {
                const auto [end, error] = std::from_chars(text.data() + i + 1, text.data() + text.size(), power);
                if (error != std::errc() || power == 0 || std::abs(power) > 9)
                    throw std::invalid_argument(
                        fmt::format("after '^' in the unit '{}' a whole number is expected", text));
                i = static_cast<std::size_t>(end - text.data());
            }
            power *= sign;
            total.dimension = total.dimension * value->dimension.power(power);
            total.decimal += power * value->decimal;
            if (value->factor != 1) total.factor *= std::pow(value->factor, power);
        } else {
            const std::string wrong = name.empty() ? std::string(text.substr(begin)) : std::string(name);
            throw std::invalid_argument(
                fmt::format("unknown unit '{}'.{} Known: {} with the prefixes {}, {} without, combined like 'kg/m^3', "
                            "'Pa s', 'N/m'",
                            wrong, didYouMean(wrong, commonUnits()), namesOf(true), prefixLetters(), namesOf(false)));
        }
        first = false;
        skipBlanks();
        if (i == text.size()) return total;
        sign = text[i] == '/' ? -1 : 1;
        if (text[i] == '/' || text[i] == '*' || text[i] == '.')
            ++i;
        else if (!isLetter(text[i]) || text[i - 1] != ' ')
            throw std::invalid_argument(fmt::format("cannot read the unit '{}' at '{}'", text, text.substr(i)));
    }
}

// Length of the number at the start of `text`, 0 when there is none.
std::size_t numberLength(std::string_view text) {
    std::size_t i = 0, digits = 0;
    if (i < text.size() && (text[i] == '+' || text[i] == '-')) ++i;
    for (; i < text.size() && isDigit(text[i]); ++i) ++digits;
    if (i < text.size() && text[i] == '.')
        for (++i; i < text.size() && isDigit(text[i]); ++i) ++digits;
    if (digits == 0) return 0;
    if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
        std::size_t j = i + 1;
        if (j < text.size() && (text[j] == '+' || text[j] == '-')) ++j;
        if (j < text.size() && isDigit(text[j])) {
            while (j < text.size() && isDigit(text[j])) ++j;
            i = j;
        }
    }
    return i;
}

double scaledNumber(std::string_view number, int decimal) {
    if (number.front() == '+') number.remove_prefix(1);
    const std::size_t e = number.find_first_of("eE");
    std::string text(number.substr(0, e));
    long exponent = decimal;
    if (e != std::string_view::npos) {
        std::string_view digits = number.substr(e + 1);
        if (digits.front() == '+') digits.remove_prefix(1);
        long written = 0;
        if (std::from_chars(digits.data(), digits.data() + digits.size(), written).ec != std::errc()) written = 1000000;
        exponent += written;
    }
    text += fmt::format("e{}", exponent);
    double value = 0;
    if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc() || !std::isfinite(value))
        throw std::invalid_argument(fmt::format("the number '{}' is beyond double precision", number));
    return value;
}

std::string raised(std::string_view symbol, int n) {
    return n == 1 ? std::string(symbol) : fmt::format("{}^{}", symbol, n);
}

struct Named {
    Dimension dimension;
    std::string_view text;
    int leadingPower;  // of the first symbol; 0: takes no prefix
};
constexpr std::array<Named, 18> namedUnits{{{unit::metre, "m", 1},
                                            {{0, 2, 0}, "m^2", 2},
                                            {{0, 3, 0}, "m^3", 3},
                                            {unit::second, "s", 1},
                                            {unit::perSecond, "1/s", 0},
                                            {unit::metrePerSecond, "m/s", 1},
                                            {unit::metrePerSecond2, "m/s^2", 1},
                                            {unit::metre2PerSecond, "m^2/s", 2},
                                            {unit::metre3PerSecond, "m^3/s", 3},
                                            {{1, 0, 0}, "kg", 0},
                                            {unit::kilogramPerMetre3, "kg/m^3", 0},
                                            {unit::pascal, "Pa", 1},
                                            {unit::pascalSecond, "Pa s", 1},
                                            {unit::newton, "N", 1},
                                            {unit::newtonPerMetre, "N/m", 1},
                                            {unit::joule, "J", 1},
                                            {unit::newtonSecondPerMetre, "N s/m", 1},
                                            {{1, 2, -3}, "W", 1}}};

const Named* named(Dimension dimension) {
    for (const Named& n : namedUnits)
        if (n.dimension == dimension) return &n;
    return nullptr;
}

}  // namespace

std::string Dimension::si() const {
    if (isDimensionless()) return "";
    if (const Named* n = named(*this)) return std::string(n->text);
    std::string above, below;
    for (const auto& [symbol, n] : {std::pair{"kg", mass}, std::pair{"m", length}, std::pair{"s", time}}) {
        if (n > 0) above += (above.empty() ? "" : " ") + raised(symbol, n);
        if (n < 0) below += "/" + raised(symbol, -n);
    }
    return (above.empty() ? "1" : above) + below;
}

Quantity parseQuantity(const std::string& written) {
    std::string text = plainUnits(written);
    const auto blank = [](char c) { return c == ' ' || c == '\n'; };
    while (!text.empty() && blank(text.back())) text.pop_back();
    while (!text.empty() && blank(text.front())) text.erase(0, 1);

    const std::size_t length = numberLength(text);
    if (length == 0) throw std::invalid_argument(fmt::format("'{}' does not start with a number", written));
    const std::string_view number = std::string_view(text).substr(0, length);
    std::string_view unitText = std::string_view(text).substr(length);
    while (!unitText.empty() && unitText.front() == ' ') unitText.remove_prefix(1);

    Quantity quantity;
    if (unitText.empty()) {
        quantity.value = scaledNumber(number, 0);
    } else if (unitText == "dx") {
        quantity.value = scaledNumber(number, 0);
        quantity.dimension = unit::metre;
        quantity.hasUnit = quantity.inSpacings = true;
    } else {
        const UnitValue unit = parseUnit(unitText);
        quantity.value = scaledNumber(number, unit.decimal) * unit.factor;
        quantity.dimension = unit.dimension;
        quantity.hasUnit = true;
    }
    return quantity;
}

std::string formatQuantity(double si, Dimension dimension, int digits) {
    const std::string unit = dimension.si();
    if (unit.empty()) return fmt::format("{:.{}g}", si, digits);
    const Named* n = named(dimension);
    if (!n || n->leadingPower == 0 || si == 0 || !std::isfinite(si)) return fmt::format("{:.{}g} {}", si, digits, unit);
    // The prefix that leaves the smallest number of at least 1 (rounded to the digits shown).
    std::string prefix;
    double scale = 1;
    const double size = std::abs(si) * (1 + 0.5 * std::pow(10.0, -digits));
    if (size < 1) {
        for (const Prefix& p : prefixes) {
            if (p.letter == 'c' || p.letter == 'a' || p.decimal > 0) continue;
            const double candidate = std::pow(10.0, p.decimal * n->leadingPower);
            if (size >= candidate || p.letter == 'f') {
                prefix = p.letter;
                scale = candidate;
            }
        }
    } else if (n->leadingPower == 1) {
        for (const Prefix& p : prefixes)
            if (p.decimal > 0 && size >= std::pow(10.0, p.decimal) && dimension != unit::metre &&
                dimension != unit::second) {
                prefix = p.letter;
                scale = std::pow(10.0, p.decimal);
            }
    }
    return fmt::format("{:.{}g} {}{}", si / scale, digits, prefix, unit);
}

}  // namespace corpuscle
