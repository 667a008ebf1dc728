#include "core/quantityForms.hpp"

#include <fmt/format.h>

#include <map>
#include <regex>
#include <utility>

namespace corpuscle {

const char* const namePattern = "[A-Za-z][A-Za-z0-9_-]*";
const char* const reservedWords =
    "true|True|TRUE|false|False|FALSE|null|Null|NULL|yes|Yes|YES|no|No|NO|on|On|ON|off|Off|OFF";

namespace {

constexpr const char* digits = "(?:[0-9]+\\.?[0-9]*|\\.[0-9]+)";
constexpr const char* exponent = "(?:[eE][+-]?0*[0-9]{1,2})?";
constexpr const char* notZero = "(?=[0.]*[1-9])";
constexpr const char* gap = "(?: +|(?!1))";        // before the unit; "81/s" is not 8 1/s
constexpr const char* between = "(?: ?[*.] ?| )";  // between factors

// Kinds of units: for each a pattern of its symbols, where '#' stands for an optional prefix.
const std::map<std::string, std::string>& kinds() {
    static const std::map<std::string, std::string> all{{"length", "#m"},
                                                        {"time", "(?:#s|min|h)"},
                                                        {"mass", "#g"},
                                                        {"force", "#(?:N|dyn)"},
                                                        {"pressure", "(?:#Pa|#bar|mmHg|[mc]mH2O)"},
                                                        {"energy", "#(?:J|erg)"},
                                                        {"poise", "#P"},
                                                        {"volume", "#[Ll]"},
                                                        {"frequency", "#Hz"},
                                                        {"power", "#W"},
                                                        {"angle", "(?:rad|deg)"}};
    return all;
}

using Form = std::vector<std::pair<const char*, int>>;

std::vector<Form> formsOf(Dimension d) {
    const auto is = [&](int mass, int length, int time) { return d == Dimension{mass, length, time}; };
    if (is(0, 3, -1)) return {{{"length", 3}, {"time", -1}}, {{"volume", 1}, {"time", -1}}};
    if (is(0, 3, 0)) return {{{"length", 3}}, {{"volume", 1}}};
    if (is(0, 0, -1)) return {{{"time", -1}}, {{"frequency", 1}}, {{"angle", 1}, {"time", -1}}};
    if (is(0, 1, -2)) return {{{"length", 1}, {"time", -2}}, {{"force", 1}, {"mass", -1}}};
    if (is(1, -3, 0)) return {{{"mass", 1}, {"length", -3}}, {{"mass", 1}, {"volume", -1}}};
    if (is(1, 1, -2)) return {{{"force", 1}}, {{"mass", 1}, {"length", 1}, {"time", -2}}};
    if (is(1, 0, -2))
        return {{{"force", 1}, {"length", -1}},
                {{"energy", 1}, {"length", -2}},
                {{"pressure", 1}, {"length", 1}},
                {{"mass", 1}, {"time", -2}}};
    if (is(1, -1, -2))
        return {{{"pressure", 1}},
                {{"force", 1}, {"length", -2}},
                {{"energy", 1}, {"length", -3}},
                {{"mass", 1}, {"length", -1}, {"time", -2}}};
    if (is(1, -1, -1))
        return {{{"pressure", 1}, {"time", 1}},
                {{"poise", 1}},
                {{"force", 1}, {"time", 1}, {"length", -2}},
                {{"mass", 1}, {"length", -1}, {"time", -1}}};
    if (is(1, 2, -2))
        return {{{"energy", 1}},
                {{"energy", 1}, {"angle", -1}},
                {{"energy", 1}, {"angle", -2}},
                {{"force", 1}, {"length", 1}},
                {{"force", 1}, {"length", 1}, {"angle", -1}},
                {{"force", 1}, {"length", 1}, {"angle", -2}},
                {{"mass", 1}, {"length", 2}, {"time", -2}}};
    if (is(1, 0, -1))
        return {{{"force", 1}, {"time", 1}, {"length", -1}},
                {{"pressure", 1}, {"time", 1}, {"length", 1}},
                {{"poise", 1}, {"length", 1}},
                {{"mass", 1}, {"time", -1}}};
    if (is(1, 2, -3)) return {{{"power", 1}}, {{"energy", 1}, {"time", -1}}};
    Form form;
    for (const auto& [kind, power] : {std::pair{"mass", d.mass}, {"length", d.length}, {"time", d.time}})
        if (power > 0) form.emplace_back(kind, power);
    for (const auto& [kind, power] : {std::pair{"mass", d.mass}, {"length", d.length}, {"time", d.time}})
        if (power < 0) form.emplace_back(kind, power);
    return {form};
}

std::string patternOf(const Form& form) {
    std::string text;
    for (const auto& [kind, power] : form) {
        const std::string& symbol = kinds().at(kind);
        const std::string raised = power == 1 || power == -1 ? "" : fmt::format("\\^{}", std::abs(power));
        if (power > 0)
            text.append(text.empty() ? "" : between).append(symbol).append(raised);
        else
            text += fmt::format("(?:{}{}{}|{}{}\\^{})", text.empty() ? "1 ?/ ?" : " ?/ ?", symbol, raised,
                                text.empty() ? "" : between, symbol, power);
    }
    return text;
}

std::string unitPattern(Dimension dimension) {
    std::string all;
    for (const Form& form : formsOf(dimension)) all += (all.empty() ? "" : "|") + patternOf(form);
    for (std::size_t at = 0; (at = all.find('#', at)) != std::string::npos;) all.replace(at, 1, "[afpnumckMG]?");
    return "(?:" + all + ")";
}

std::string signedNumber(const Range& range) {
    if (range.low > 0 || (range.low == 0 && range.lowOpen)) return std::string("\\+?") + notZero + digits + exponent;
    if (range.low == 0) return std::string("\\+?") + digits + exponent;
    return std::string("[+-]?") + digits + exponent;
}

void replaceAll(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
}

// Signs in UTF-8 and the plain ones that they stand for.
constexpr std::pair<const char*, const char*> signs[] = {{"\xC2\xB5", "u"},
                                                         {"\xCE\xBC", "u"},  // micro sign, Greek mu
                                                         {"\xC2\xB7", "*"},
                                                         {"\xE2\x8B\x85", "*"},  // middle dot, dot operator
                                                         {"\xE2\x81\xBB\xC2\xB9", "^-1"},
                                                         {"\xE2\x81\xBB\xC2\xB2", "^-2"},
                                                         {"\xE2\x81\xBB\xC2\xB3", "^-3"},
                                                         {"\xC2\xB2", "^2"},
                                                         {"\xC2\xB3", "^3"}};

}  // namespace

std::string quantityPattern(Dimension dimension, const Range& range) {
    if (dimension.isDimensionless()) return signedNumber(range);
    return signedNumber(range) + gap + unitPattern(dimension);
}

std::string lengthPattern(const Range& range) {
    return signedNumber(range) + gap + "(?:dx|" + unitPattern(unit::metre) + ")";
}

std::string intervalPattern() {
    return "never|" + signedNumber(positive) + gap + "(?:strain|" + unitPattern(unit::second) + ")|\\+?" + notZero +
           "[0-9]+\\.?0*(?:[eE]\\+?0*[0-9]{1,2})? *steps?";
}

std::string integerPattern(const Range& range) {
    return std::string(range.low >= 0 ? "\\+?" : "[+-]?") + (range.low > 0 ? notZero : "") +
           "[0-9]+\\.?0*(?:[eE]\\+?0*(?:[0-9]|1[0-2]))?";
}

std::string withUnicode(std::string pattern) {
    replaceAll(pattern, "[afpnumckMG]", "[afpnu\xC2\xB5\xCE\xBCmckMG]");
    replaceAll(pattern, "[*.]", "[*.\xC2\xB7\xE2\x8B\x85]");
    for (const int n : {1, 2, 3}) {
        const char* const raised = n == 1 ? "\xC2\xB9" : n == 2 ? "\xC2\xB2" : "\xC2\xB3";
        replaceAll(pattern, fmt::format("\\^-{}", n), fmt::format("(?:\\^-{0}|\xE2\x81\xBB{1})", n, raised));
        if (n > 1) replaceAll(pattern, fmt::format("\\^{}", n), fmt::format("(?:\\^{0}|{1})", n, raised));
    }
    return pattern;
}

std::string plainUnits(std::string text) {
    for (const auto& [sign, plain] : signs) replaceAll(text, sign, plain);
    return text;
}

bool matches(const std::string& text, const std::string& pattern) {
    constexpr std::size_t longest = 200;  // std::regex recurses along the text
    if (text.size() > longest) return false;
    static std::map<std::string, std::regex> compiled;
    auto found = compiled.find(pattern);
    if (found == compiled.end()) found = compiled.emplace(pattern, std::regex(pattern)).first;
    return std::regex_match(text, found->second);
}

std::vector<std::string> usualUnits(Dimension d) {
    using Words = std::vector<std::string>;
    const auto is = [&](int mass, int length, int time) { return d == Dimension{mass, length, time}; };
    if (is(0, 1, 0)) return Words{"um", "nm", "mm", "cm", "m", "pm", "fm", "km"};
    if (is(0, 2, 0)) return Words{"um^2", "nm^2", "mm^2", "cm^2", "m^2"};
    if (is(0, 3, 0)) return Words{"um^3", "fL", "pL", "nL", "uL", "mL", "L", "mm^3", "cm^3", "m^3", "nm^3"};
    if (is(0, 0, 1)) return Words{"s", "ms", "us", "ns", "ps", "min", "h"};
    if (is(0, 3, -1))
        return Words{"m^3/s", "um^3/s", "mm^3/s", "uL/min", "nL/min", "uL/s", "nL/s", "pL/s", "mL/min", "L/min"};
    if (is(0, 0, -1)) return Words{"1/s", "1/ms", "1/us", "1/min", "Hz", "kHz", "MHz", "rad/s", "s^-1"};
    if (is(0, -1, 0)) return Words{"1/um", "1/nm", "1/mm", "1/m", "um^-1"};
    if (is(0, 1, -1)) return Words{"mm/s", "um/s", "nm/s", "cm/s", "m/s", "um/ms"};
    if (is(0, 1, -2)) return Words{"m/s^2", "mm/s^2", "um/s^2", "N/kg"};
    if (is(1, 0, 0)) return Words{"kg", "g", "mg", "ug", "pg"};
    if (is(1, -3, 0)) return Words{"kg/m^3", "g/cm^3", "g/mL", "g/L", "kg/L", "pg/um^3"};
    if (is(1, 1, -2)) return Words{"pN", "nN", "uN", "mN", "N", "dyn", "udyn"};
    if (is(1, 0, -2))
        return Words{"N/m", "mN/m", "uN/m", "nN/m", "pN/um", "pN/nm", "dyn/cm", "mdyn/cm", "J/m^2", "mJ/m^2"};
    if (is(1, -1, -2))
        return Words{"Pa",   "kPa",   "MPa",   "GPa",      "mPa",   "bar",    "mbar",
                     "mmHg", "mmH2O", "cmH2O", "dyn/cm^2", "N/m^2", "pN/um^2"};
    if (is(1, -1, -1)) return Words{"Pa s", "mPa s", "uPa s", "cP", "P", "N s/m^2", "kg/m/s", "g/cm/s", "dyn s/cm^2"};
    if (is(1, 2, -2)) return Words{"J", "aJ", "fJ", "pJ", "pN nm", "pN um", "nN nm", "N m", "N m/rad", "erg"};
    if (is(1, 0, -1)) return Words{"N s/m", "uN s/m", "nN s/m", "pN s/um", "dyn s/cm", "mPa s m", "kg/s"};
    return {d.si()};
}

std::string nearestUnit(const std::string& unit, Dimension dimension) {
    static const std::map<std::string, std::string> spelled{
        {"micron", "um"},     {"microns", "um"},    {"micrometer", "um"}, {"micrometre", "um"},   {"micrometers", "um"},
        {"meter", "m"},       {"metre", "m"},       {"meters", "m"},      {"metres", "m"},        {"nanometer", "nm"},
        {"millimeter", "mm"}, {"sec", "s"},         {"second", "s"},      {"seconds", "s"},       {"secs", "s"},
        {"msec", "ms"},       {"usec", "us"},       {"minutes", "min"},   {"minute", "min"},      {"mins", "min"},
        {"hours", "h"},       {"hour", "h"},        {"hr", "h"},          {"hrs", "h"},           {"poise", "P"},
        {"Poise", "P"},       {"centipoise", "cP"}, {"dyne", "dyn"},      {"dynes/cm", "dyn/cm"}, {"dyne/cm", "dyn/cm"},
        {"pascal", "Pa"},     {"Pascal", "Pa"},     {"newton", "N"},      {"Newton", "N"},        {"joule", "J"},
        {"Joule", "J"},       {"Pas", "Pa s"},      {"mPas", "mPa s"},    {"torr", "mmHg"},       {"Torr", "mmHg"},
        {"gcm-3", "g/cm^3"},  {"cc", "cm^3"},       {"cps", "cP"},        {"per second", "1/s"}};
    const std::string plain = plainUnits(unit);
    const std::string pattern = unitPattern(dimension);
    if (const auto found = spelled.find(plain); found != spelled.end() && matches(found->second, pattern))
        return found->second;
    return nearestWord(plain, usualUnits(dimension));
}

std::string unitOf(const std::string& quantity) {
    static const std::regex number(std::string(" *[+-]?") + digits + "(?:[eE][+-]?[0-9]+)? *");
    std::smatch found;
    if (quantity.size() > 200 || !std::regex_search(quantity, found, number, std::regex_constants::match_continuous))
        return quantity;
    return found.suffix();
}

}  // namespace corpuscle
