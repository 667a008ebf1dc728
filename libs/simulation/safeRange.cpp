#include "simulation/safeRange.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "simulation/groups.hpp"
#include "simulation/safeRangeTable.hpp"

namespace corpuscle::simulation {

namespace {

// Largest Ca of a stiff cell: with a finer mesh it rotated too fast at 0.002, not at 0.02.
constexpr double stiffest = 0.005;
constexpr double rounding = 1e-6;  // relative, of numbers such as 0.05 after conversion of units and division
constexpr const char* header = "axis,integrator,low,high,outside";

double number(const std::string& word, const std::string& line) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (word.empty() || *end) throw std::invalid_argument("'" + word + "' is no number: " + line);
    return value;
}

std::optional<double> valueOf(const Case& input, const std::string& axis) {
    const NumericsSettings& numerics = input.numerics;
    if (const std::string own = numerics.integrator + "."; axis.starts_with(own)) {
        const Node settings = Registry<schemes::Scheme>::instance()
                                  .find(numerics.integrator)
                                  ->write(*numerics.tables.of(numerics.integrator));
        return parseQuantity(settings.find(axis.substr(own.size()))->scalar).value;
    }
    if (axis == "shifting.coefficient")
        return numerics.shifting ? std::optional(numerics.shifting->coefficient) : std::nullopt;
    if (axis == "fill.jitter") return input.mesh.fill.jitter;
    if (axis == "bulkModulus") {
        const double ratio = input.soundSpeed() / input.automaticSoundSpeed();
        return ratio * ratio;
    }
    return std::nullopt;
}

// Values of a case on an axis, with their names: one value, or those of all cells without repetition.
std::vector<std::pair<std::string, double>> valuesOf(const Case& input, const std::vector<Group>& groups,
                                                     const std::string& axis) {
    std::vector<std::pair<std::string, double>> values;
    if (const auto value = valueOf(input, axis)) values.emplace_back(axis, *value);
    if (axis == "stiffEdge")
        for (const CellSettings& cell : input.mesh.cells) {
            const double edge = cell.edge / input.spacing();
            const bool isNamed = std::any_of(values.begin(), values.end(), [&](auto& v) { return v.second == edge; });
            if (capillaryNumber(input, cell) <= stiffest * (1 + rounding) && !isNamed)
                values.emplace_back("edge/dx of '" + cell.name + "'", edge);
        }
    for (const Group& g : groups)
        if (g.symbol == axis) values.emplace_back(g.name, g.number);
    return values;
}

}  // namespace

std::vector<SafeRange> parseSafeRanges(const std::string& table) {
    std::vector<SafeRange> ranges;
    std::istringstream lines(table);
    bool begun = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line[0] == '#') continue;
        if (!begun) {
            if (line != header) throw std::invalid_argument(std::string("the header is not ") + header + ": " + line);
            begun = true;
            continue;
        }
        std::istringstream words(line);
        std::string word[4];
        SafeRange range;
        for (std::string& w : word) std::getline(words, w, ',');
        std::getline(words, range.outside);  // to the end, commas included
        if (range.outside.size() > 1 && range.outside.front() == '"' && range.outside.back() == '"')
            range.outside = range.outside.substr(1, range.outside.size() - 2);
        if (range.outside.empty()) throw std::invalid_argument("fewer than five columns: " + line);
        range.axis = word[0], range.integrator = word[1];
        range.low = number(word[2], line), range.high = number(word[3], line);
        if (!(range.low <= range.high)) throw std::invalid_argument("low is above high: " + line);
        ranges.push_back(std::move(range));
    }
    return ranges;
}

const std::vector<SafeRange>& safeRanges() {
    static const std::vector<SafeRange> ranges = parseSafeRanges(safeRangeTable);
    return ranges;
}

std::vector<std::string> outsideSafeRanges(const Case& input, const std::vector<SafeRange>& ranges) {
    std::vector<std::string> words;
    if (input.mesh.cells.empty()) return words;
    const std::vector<Group> groups = dimensionlessGroups(input);
    for (const SafeRange& range : ranges) {
        if (range.integrator != input.numerics.integrator) continue;
        for (const auto& [name, value] : valuesOf(input, groups, range.axis)) {
            if (value >= range.low * (1 - rounding) && value <= range.high * (1 + rounding)) continue;
            words.push_back(
                fmt::format("{} = {:.4g} is outside {:g} to {:g}, where {} is known to be safe: {} (docs/stability.md)",
                            name, value, range.low, range.high, range.integrator, range.outside));
        }
    }
    return words;
}

}  // namespace corpuscle::simulation
