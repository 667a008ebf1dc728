// How single values are read and written. Every message says what was found and what is allowed.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/settings.hpp"

namespace corpuscle::codec {
namespace {

void complain(const Node& node, Problems& problems, const std::string& message) {
    problems.add(node.isNothing() ? node.place() : node.mark, node.path, message);
}

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
    complain(node, problems, fmt::format("'{}' is out of range: it must be {}", node.scalar, range.text(dimension)));
    return false;
}

// One number with its unit.
std::optional<double> readNumber(const Node& node, Dimension dimension, const Range& range, Problems& problems) {
    const std::string si = dimension.si();
    const std::string expected =
        si.empty() ? "a number" : fmt::format("a quantity in {} (like '{}')", si, exampleOf(dimension));
    if (!isScalar(node, expected, problems)) return std::nullopt;
    Quantity q;
    try {
        q = parseQuantity(node.scalar);
    } catch (const std::invalid_argument& e) {
        complain(node, problems, fmt::format("{}; {} is expected", e.what(), expected));
        return std::nullopt;
    }
    const std::string& found = node.scalar;
    if (q.inSpacings) {
        complain(
            node, problems,
            fmt::format("'{}' is in particle spacings, which are not allowed here; {} is expected", found, expected));
    } else if (!q.hasUnit && !si.empty()) {
        complain(node, problems, fmt::format("'{}' has no unit; {} is expected", node.scalar, expected));
    } else if (q.dimension != dimension) {
        complain(node, problems,
                 si.empty() ? fmt::format("'{}' has a unit, but this is a number without one", found)
                            : fmt::format("'{}' is in {}; {} is expected", found,
                                          q.dimension.isDimensionless() ? "radians" : q.dimension.si(), expected));
    } else if (inRange(node, q.value, dimension, range, problems)) {
        return q.value;
    }
    return std::nullopt;
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
             fmt::format("'{}' is not allowed.{} Allowed: {}", node.scalar, didYouMean(node.scalar, allowed),
                         joinWords(allowed)));
    return false;
}

// The text without a final "<unit>", if it ends so.
std::optional<std::string> without(const std::string& text, const std::string& unit) {
    if (text.size() <= unit.size() + 1 || !text.ends_with(" " + unit)) return std::nullopt;
    return text.substr(0, text.size() - unit.size() - 1);
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
                if (!isListOf(node, 0, "a list of numbers, each with its unit", problems) || !hasNoUnit(node, problems))
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
                long read = 0;
                const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), read);
                if (error != std::errc() || end != text.data() + text.size()) {
                    double real = 0.5;  // "1e6" is a whole number too
                    const auto [e, err] = std::from_chars(text.data(), text.data() + text.size(), real);
                    if (err != std::errc() || e != text.data() + text.size() || real != std::floor(real) ||
                        std::abs(real) > 9e15) {
                        complain(node, problems, fmt::format("'{}' is no whole number", text));
                        return;
                    }
                    read = static_cast<long>(real);
                }
                if (inRange(node, static_cast<double>(read), unit::none, range, problems)) value = read;
            },
            [](const long& value) { return Node::word(fmt::format("{}", value)); }};
}

Codec<bool> boolean() {
    return {[](const Node& node, bool& value, Problems& problems) {
                if (node.kind == Node::Kind::scalar && (node.scalar == "true" || node.scalar == "false"))
                    value = node.scalar == "true";
                else
                    complain(node, problems, fmt::format("found {}; true or false is expected", node.kindText()));
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
    return {[allowed = std::move(allowed)](const Node& node, std::vector<std::string>& values, Problems& problems) {
                if (!isListOf(node, 0, "a list of words", problems) || !hasNoUnit(node, problems)) return;
                values.clear();
                for (const Node& item : node.items)
                    if (!isScalar(item, "a word", problems))
                        continue;
                    else if (!allowed.empty() ? isAllowed(item, allowed, problems) : isName(item.scalar))
                        values.push_back(item.scalar);
                    else if (allowed.empty())
                        complain(
                            item, problems,
                            fmt::format("'{}' is no name: a letter, then letters, digits, '-' and '_'", item.scalar));
            },
            [](const std::vector<std::string>& values) { return Node::list(values); }};
}

Codec<std::string> name() {
    return {[](const Node& node, std::string& value, Problems& problems) {
                if (!isScalar(node, "a name", problems)) return;
                if (isName(node.scalar))
                    value = node.scalar;
                else
                    complain(node, problems,
                             fmt::format("'{}' is no name: a letter, then letters, digits, '-' and '_'", node.scalar));
            },
            [](const std::string& value) { return Node::word(value); }};
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
                    if (!read) return;  // one message for a unit that all three lack
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
                for (std::size_t k = 0; k < 3; ++k) {
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
                for (std::size_t k = 0; k < 3; ++k) one.read(node.items[k], value[k], problems);
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

Codec<Interval> interval(Range range) {
    return {
        [=](const Node& node, Interval& value, Problems& problems) {
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
            Range limits = range;
            if (limits.low < 0 || (limits.low == 0 && !limits.lowOpen)) limits.low = 0, limits.lowOpen = true;
            Problems own;
            const auto read = readNumber(number, kind == Kind::time ? unit::second : unit::none, limits, own);
            if (!read || (kind == Kind::steps && *read != std::floor(*read)))
                complain(node, problems,
                         fmt::format(
                             "'{}' is no interval: write '0.1 strain', '1e-5 s', '5 min' or '100 steps' (all greater "
                             "than 0, steps whole), or never",
                             node.scalar));
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
