// How single values are read and written. Every message says what was found and what is allowed.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <regex>
#include <stdexcept>
#include <utility>

#include "core/quantityForms.hpp"
#include "core/settings.hpp"

namespace corpuscle::codec {
namespace {

void complain(const Node& node, Problems& problems, const std::string& message) {
    problems.add(node.isNothing() ? node.place() : node.mark, node.path, message);
}

std::string shown(const std::string& text) { return shortened(text, 80); }

bool isScalar(const Node& node, const std::string& expected, Problems& problems) {
    if (node.kind == Node::Kind::scalar && !node.isNothing()) return true;
    complain(node, problems, fmt::format("found {}; {} is expected", node.kindText(), expected));
    return false;
}

std::string exampleOf(Dimension dimension) {
    FieldInfo info;
    info.type = "quantity";
    info.dimension = dimension;
    return info.example();
}

// "0.001 Pa s": the shortest text that gives the same double again.
std::string exactText(double value, Dimension dimension) {
    return dimension.isDimensionless() ? fmt::format("{}", value) : fmt::format("{} {}", value, dimension.si());
}

bool inRange(const Node& node, double value, Dimension dimension, const Range& range, Problems& problems) {
    if (range.contains(value)) return true;
    complain(node, problems,
             fmt::format("'{}' is out of range: it must be {}", shown(node.scalar), range.text(dimension)));
    return false;
}

// Why a text that people write for a number is not read as one; "" where there is no particular reason.
std::string whyNoNumber(const std::string& text) {
    static const std::regex notFinite("[+-]?[.]?(?:nan|inf|infinity)(?: .*)?", std::regex::icase),
        hexadecimal("[+-]?0[xX].*"), octal("0o[0-7]+.*"), comma("([+-]?[0-9]+),([0-9]+)(.*)"),
        grouped("[+-]?[0-9]+(?:_[0-9]+)+.*"), variable("[$%#@]\\{?[A-Za-z].*|\\{\\{.*"),
        expression("[+-]?[0-9.]+ ?(?:[*/x+]|\xC3\x97|\\*\\*) ?[0-9].*|sqrt.*|pi.*"), percent("[+-]?[0-9.]+ ?%"),
        ending("(.*[^ ]) *[;,]"), minus("(?:\xE2\x88\x92|\xE2\x80\x93).*");
    std::smatch part;
    if (text.size() > 200) return "it is too long for one";
    if (std::regex_match(text, notFinite)) return "it is not a finite number";
    if (std::regex_match(text, hexadecimal) || std::regex_match(text, octal)) return "only decimal numbers are read";
    if (std::regex_match(text, part, ending)) return fmt::format("nothing ends with '{}' here: remove it", text.back());
    if (std::regex_match(text, part, comma))
        return fmt::format("decimals are written with a point, '{}.{}{}'", part[1].str(), part[2].str(), part[3].str());
    if (std::regex_match(text, percent)) return "percentages are not read: divide by 100";
    if (std::regex_match(text, grouped)) return "digits are not grouped with '_'";
    if (std::regex_match(text, variable))
        return "there are no variables in a dictionary: write the value out, or give it with -set";
    if (std::regex_match(text, expression)) return "expressions are not evaluated: write their value";
    if (std::regex_match(text, minus)) return "its first sign is a dash, write '-'";
    return "";
}

// Whether the magnitude of the number at the start of the text is too large or too small for any setting.
bool isBeyond(const std::string& text) {
    const char* first = text.data() + (!text.empty() && text[0] == '+');
    double number = 0;
    const auto [end, error] = std::from_chars(first, text.data() + text.size(), number);
    const double size = std::abs(number);
    return error == std::errc::result_out_of_range ||
           (error == std::errc() && size != 0 && !(size >= leastNumber && size < largestNumber));
}

std::string unitsOf(Dimension dimension) {
    std::vector<std::string> usual = usualUnits(dimension);
    constexpr std::size_t most = 8;
    if (usual.size() > most) usual.resize(most);
    return joinWords(usual);
}

// One number with its unit.
std::optional<double> readNumber(const Node& node, Dimension dimension, const Range& range, Problems& problems) {
    const std::string si = dimension.si();
    const std::string expected =
        si.empty() ? "a number" : fmt::format("a quantity in {} (like '{}')", si, exampleOf(dimension));
    if (!isScalar(node, expected, problems)) return std::nullopt;
    const std::string& text = node.scalar;
    const std::string found = shown(text);
    const auto wrong = [&](const std::string& message) {
        complain(node, problems, message);
        return std::nullopt;
    };
    if (const std::string why = whyNoNumber(text); !why.empty())
        return wrong(fmt::format("'{}' is not a number: {}; {} is expected", found, why, expected));
    if (isBeyond(text))
        return wrong(fmt::format("'{}' is beyond what can be computed with: numbers lie between {} and {} in size",
                                 found, leastNumber, largestNumber));
    Quantity q;
    try {
        q = parseQuantity(text);
    } catch (const std::invalid_argument&) {
        const std::string unit = unitOf(text);
        if (unit == text)
            return wrong(fmt::format("'{}' does not start with a number; {} is expected", found, expected));
        if (si.empty())
            return wrong(fmt::format("'{}' has something after the number; a number without unit is expected", found));
        const std::string nearest = nearestUnit(unit, dimension);
        return wrong(fmt::format("unknown unit '{}'.{} Known for {}: {}", shown(unit),
                                 nearest.empty() ? "" : fmt::format(" Did you mean '{}'?", nearest), si,
                                 unitsOf(dimension)));
    }
    if (q.inSpacings)
        return wrong(
            fmt::format("'{}' is in particle spacings, which are not allowed here; {} is expected", found, expected));
    if (!q.hasUnit && !si.empty()) return wrong(fmt::format("'{}' has no unit; {} is expected", found, expected));
    if (si.empty() && q.hasUnit) {
        const std::string number = text.substr(0, text.size() - unitOf(text).size());
        return wrong(fmt::format("'{}' has a unit; a number without a unit is needed: write '{}'", found,
                                 number.substr(0, number.find_last_not_of(' ') + 1)));
    }
    if (q.dimension != dimension)
        return wrong(fmt::format("'{}' is in {}; {} is expected", found,
                                 q.dimension.isDimensionless() ? "radians" : q.dimension.si(), expected));
    if (!inRange(node, q.value, dimension, range, problems)) return std::nullopt;
    if (!matches(plainUnits(text), quantityPattern(dimension, range))) {
        const std::string nearest = nearestUnit(unitOf(text), dimension);
        return wrong(fmt::format("'{}' is written in a way that is not read.{} Units of {}: {}", found,
                                 nearest.empty() ? "" : fmt::format(" Did you mean '{}'?", nearest),
                                 si.empty() ? "numbers: none" : si, unitsOf(dimension)));
    }
    return q.value;
}

bool isListOf(const Node& node, std::size_t n, const std::string& expected, Problems& problems) {
    if (node.kind == Node::Kind::list && (n == 0 || node.items.size() == n)) return true;
    complain(node, problems, fmt::format("found {}; {} is expected", node.kindText(), expected));
    return false;
}

// "[20, 16, 16] um" is not YAML: the cure is shown where the items are plain numbers.
bool hasNoUnit(const Node& list, Problems& problems) {
    if (list.unit.empty()) return true;
    std::vector<std::string> old, cured;
    for (const Node& item : list.items) {
        old.push_back(item.scalar);
        cured.push_back(item.scalar + " " + list.unit);
    }
    complain(list, problems,
             fmt::format("'[{}] {}' is not YAML: a unit cannot follow a list. Give each number its own, '[{}]'; "
                         "etc/convertVectors rewrites whole cases",
                         joinWords(old), list.unit, joinWords(cured)));
    return false;
}

bool isAllowed(const Node& node, const std::vector<std::string>& allowed, Problems& problems) {
    for (const std::string& a : allowed)
        if (a == node.scalar) return true;
    complain(node, problems,
             fmt::format("'{}' is not allowed.{} Allowed: {}", shown(node.scalar), didYouMean(node.scalar, allowed),
                         joinWords(allowed)));
    return false;
}

// The text without a final `unit`, if it is a number followed by that unit.
std::optional<std::string> without(const std::string& text, const std::string& unit) {
    if (text.size() <= unit.size() || !text.ends_with(unit)) return std::nullopt;
    std::string number = text.substr(0, text.size() - unit.size());
    number.erase(number.find_last_not_of(' ') + 1);
    const bool isNumber = !number.empty() && (number.back() == '.' || (number.back() >= '0' && number.back() <= '9'));
    return isNumber ? std::optional(number) : std::nullopt;
}

bool isNameOf(const Node& node, const std::string& text, Problems& problems) {
    if (!isName(text))
        complain(node, problems,
                 fmt::format("'{}' is not a name: a letter, then letters, digits, '-' and '_'", shown(text)));
    else if (matches(text, reservedWords))
        complain(node, problems,
                 fmt::format("'{}' is not a name: YAML reads it as true, false or nothing; take another", text));
    else
        return true;
    return false;
}

}  // namespace

Codec<double> quantity(Dimension dimension, Range range) {
    return {[=](const Node& node, double& value, Problems& problems) {
                if (const auto read = readNumber(node, dimension, range, problems)) value = *read;
            },
            [=](const double& value) { return Node::word(exactText(value, dimension)); }};
}

Codec<std::vector<double>> quantities(Dimension dimension, Range range) {
    return {[=](const Node& node, std::vector<double>& values, Problems& problems) {
                FieldInfo info;
                info.type = "quantities";
                info.dimension = dimension;
                if (!isListOf(node, 0, fmt::format("a list like '{}'", info.example()), problems) ||
                    !hasNoUnit(node, problems))
                    return;
                values.clear();
                for (const Node& item : node.items) {
                    const auto read = readNumber(item, dimension, range, problems);
                    if (!read) return;
                    values.push_back(*read);
                }
            },
            [=](const std::vector<double>& values) {
                std::vector<std::string> texts;
                texts.reserve(values.size());
                for (double v : values) texts.push_back(exactText(v, dimension));
                return Node::list(texts);
            }};
}

Codec<long> integer(Range range) {
    return {[=](const Node& node, long& value, Problems& problems) {
                if (!isScalar(node, "a whole number", problems)) return;
                const std::string& text = node.scalar;
                const auto wrong = [&](const std::string& why) {
                    complain(node, problems, fmt::format("'{}' is not a whole number{}", shown(text), why));
                };
                if (const std::string why = whyNoNumber(text); !why.empty()) return wrong(": " + why);
                const char* const first = text.data() + (text.starts_with('+') ? 1 : 0);
                const char* const last = text.data() + text.size();
                double real = 0;  // "1e6" is a whole number too
                const auto [end, error] = std::from_chars(first, last, real);
                if (error != std::errc() || end != last || real != std::floor(real)) return wrong("");
                if (std::abs(real) > largestInteger)
                    return wrong(fmt::format(" that can be counted to; at most {}", largestInteger));
                if (!inRange(node, real, unit::none, range, problems)) return;
                if (node.quoted && !matches(text, integerPattern(range))) return wrong(": write its digits");
                value = static_cast<long>(real);
            },
            [](const long& value) { return Node::word(fmt::format("{}", value)); }};
}

Codec<bool> boolean() {
    return {[](const Node& node, bool& value, Problems& problems) {
                const bool isWord = node.kind == Node::Kind::scalar && !node.quoted;
                if (isWord && matches(node.scalar, "true|True|TRUE"))
                    value = true;
                else if (isWord && matches(node.scalar, "false|False|FALSE"))
                    value = false;
                else
                    complain(node, problems,
                             fmt::format("found {}; true or false is expected{}", node.kindText(),
                                         node.quoted ? ", without quotation marks" : ""));
            },
            [](const bool& value) { return Node::word(value ? "true" : "false"); }};
}

Codec<std::string> word(std::vector<std::string> allowed) {
    return {[allowed = std::move(allowed)](const Node& node, std::string& value, Problems& problems) {
                if (isScalar(node, fmt::format("one of {}", joinWords(allowed)), problems) &&
                    isAllowed(node, allowed, problems))
                    value = node.scalar;
            },
            [](const std::string& value) { return Node::word(value); }};
}

Codec<std::vector<std::string>> words(std::vector<std::string> allowed) {
    return {
        [allowed = std::move(allowed)](const Node& node, std::vector<std::string>& values, Problems& problems) {
            if (!isListOf(node, 0,
                          fmt::format("a list like '[{}]'",
                                      joinWords(allowed.empty() ? std::vector<std::string>{"one", "two"} : allowed)),
                          problems) ||
                !hasNoUnit(node, problems))
                return;
            values.clear();
            for (const Node& item : node.items)
                if (!isScalar(item, "a word", problems))
                    continue;
                else if (!allowed.empty() ? isAllowed(item, allowed, problems) : isNameOf(item, item.scalar, problems))
                    values.push_back(item.scalar);
        },
        [](const std::vector<std::string>& values) { return Node::list(values); }};
}

Codec<std::string> name() {
    return {[](const Node& node, std::string& value, Problems& problems) {
                if (isScalar(node, "a name", problems) && isNameOf(node, node.scalar, problems)) value = node.scalar;
            },
            [](const std::string& value) { return Node::word(value); }};
}

Codec<std::vector<std::string>> values() {
    return {[](const Node& node, std::vector<std::string>& values, Problems& problems) {
                if (!isListOf(node, 0, "a list like '[0.1, 0.2]'", problems) || !hasNoUnit(node, problems)) return;
                values.clear();
                for (const Node& item : node.items)
                    if (item.isNothing())
                        complain(item, problems, "found nothing; a value is expected");
                    else
                        values.push_back(item.kind == Node::Kind::scalar ? item.scalar : emitInLine(item));
            },
            [](const std::vector<std::string>& values) { return Node::list(values); }};
}
Codec<std::string> text() {
    return {[](const Node& node, std::string& value, Problems& problems) {
                if (isScalar(node, "a text", problems)) value = node.scalar;
            },
            [](const std::string& value) {
                Node node = Node::word(value);
                node.quoted = true;
                return node;
            }};
}

Codec<std::string> wordOrQuantity(const std::vector<std::string>& allowed, Dimension dimension, Range range) {
    return {[=](const Node& node, std::string& value, Problems& problems) {
                const std::string expected = fmt::format("{}, or a quantity in {} (like '{}')", joinWords(allowed),
                                                         dimension.si(), exampleOf(dimension));
                if (!isScalar(node, expected, problems)) return;
                Problems own;
                const bool isWord = std::find(allowed.begin(), allowed.end(), node.scalar) != allowed.end();
                const std::string& text = node.scalar;
                if (isWord || readNumber(node, dimension, range, own))
                    value = text;
                else if (unitOf(text) == text)
                    complain(node, problems,
                             fmt::format("'{}' is not allowed.{} Allowed: {}", shown(text), didYouMean(text, allowed),
                                         expected));
                else
                    readNumber(node, dimension, range, problems);
            },
            [](const std::string& value) { return Node::word(value); }};
}

Codec<Vec3> vector(Dimension dimension, Range range) {
    return {[=](const Node& node, Vec3& value, Problems& problems) {
                FieldInfo info;
                info.type = "vector";
                info.dimension = dimension;
                if (!isListOf(node, 3, fmt::format("a vector like '{}'", info.example()), problems) ||
                    !hasNoUnit(node, problems))
                    return;
                Vec3 components;
                for (int k = 0; k < 3; ++k) {
                    const auto read = readNumber(node.items[static_cast<std::size_t>(k)], dimension, range, problems);
                    if (!read) return;  // a unit that all three lack gives one message
                    components[k] = *read;
                }
                value = components;
            },
            [=](const Vec3& value) {
                std::vector<std::string> texts;
                for (double v : value) texts.push_back(exactText(v, dimension));
                return Node::list(texts);
            }};
}

Codec<Index3> integers(Range range) {
    const Codec<long> one = integer(range);
    return {[=](const Node& node, Index3& value, Problems& problems) {
                if (!isListOf(node, 3, "three whole numbers like '[1, 2, 3]'", problems) || !hasNoUnit(node, problems))
                    return;
                const std::size_t before = problems.count();
                for (std::size_t k = 0; k < 3 && problems.count() == before; ++k) {
                    long read = value[k];
                    one.read(node.items[k], read, problems);
                    value[k] = static_cast<int>(read);
                }
            },
            [](const Index3& v) {
                return Node::list({std::to_string(v[0]), std::to_string(v[1]), std::to_string(v[2])});
            }};
}

Codec<std::array<bool, 3>> booleans() {
    const Codec<bool> one = boolean();
    return {[=](const Node& node, std::array<bool, 3>& value, Problems& problems) {
                if (!isListOf(node, 3, "three of true or false like '[true, true, false]'", problems) ||
                    !hasNoUnit(node, problems))
                    return;
                const std::size_t before = problems.count();  // a mistake in all three gives one message
                for (std::size_t k = 0; k < 3 && problems.count() == before; ++k)
                    one.read(node.items[k], value[k], problems);
            },
            [=](const std::array<bool, 3>& v) {
                Node node = Node::list({});
                for (bool b : v) node.items.push_back(one.write(b));
                return node;
            }};
}

Codec<Length> length(Range range) {
    return {[=](const Node& node, Length& value, Problems& problems) {
                const auto spacings = node.kind == Node::Kind::scalar ? without(node.scalar, "dx") : std::nullopt;
                Node number = node;
                if (spacings) number.scalar = *spacings;
                if (const auto read = readNumber(number, spacings ? unit::none : unit::metre, range, problems))
                    value = {*read, spacings.has_value()};
            },
            [](const Length& value) {
                return Node::word(value.inSpacings ? fmt::format("{} dx", value.value)
                                                   : exactText(value.value, unit::metre));
            }};
}

Codec<Interval> interval(Range) {
    return {
        [](const Node& node, Interval& value, Problems& problems) {
            if (!isScalar(node, "an interval like '0.1 strain', '1e-5 s' or '100 steps', or never,", problems)) return;
            if (node.scalar == "never") {
                value = {};
                return;
            }
            using Kind = Interval::Kind;
            Kind kind = Kind::time;
            Node number = node;
            for (const auto& [unit, its] :
                 {std::pair{"strain", Kind::strain}, std::pair{"steps", Kind::steps}, std::pair{"step", Kind::steps}})
                if (const auto text = without(node.scalar, unit)) {
                    number.scalar = *text;
                    kind = its;
                }
            Problems own;
            const auto read = readNumber(number, kind == Kind::time ? unit::second : unit::none, positive, own);
            if (!read || !matches(plainUnits(node.scalar), intervalPattern()))
                complain(node, problems,
                         fmt::format("'{}' is not an interval: write '0.1 strain', '1e-5 s', '5 min' or '100 steps' "
                                     "(all greater than 0, steps whole), or never",
                                     shown(node.scalar)));
            else
                value = {kind, *read};
        },
        [](const Interval& value) {
            switch (value.kind) {
                case Interval::Kind::strain:
                    return Node::word(fmt::format("{} strain", value.value));
                case Interval::Kind::steps:
                    return Node::word(fmt::format("{} steps", value.value));
                case Interval::Kind::time:
                    return Node::word(fmt::format("{} s", value.value));
                case Interval::Kind::never:
                    break;
            }
            return Node::word("never");
        }};
}

}  // namespace corpuscle::codec
