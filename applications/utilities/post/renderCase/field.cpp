#include "field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace corpuscle {
namespace {

using Colours = FieldStyle::Colours;

// The unit in which the larger bound of a range is at least 1, and its value in SI: "mm/s" and 1e-3.
std::pair<std::string, double> unitFor(const ValueRange& range, Dimension dimension) {
    if (dimension.isDimensionless()) return {"", 1};
    const double size = std::max(std::abs(range.low), std::abs(range.high));
    // The prefix is taken from a formatted quantity, such as "3.2 mm/s".
    const std::string text = formatQuantity(size > 0 && std::isfinite(size) ? size : 1, dimension, 3);
    const std::string name = text.substr(text.find(' ') + 1);
    std::string shown = name;
    if (shown.starts_with('u')) shown.replace(0, 1, "\u00b5");
    return {shown, parseQuantity("1 " + name).value};
}

vtkSmartPointer<vtkLookupTable> colourTable(const FieldStyle& style, const ValueRange& range) {
    auto table = vtkSmartPointer<vtkLookupTable>::New();
    const bool ofKinds = style.colours == Colours::kinds;
    const int count = ofKinds ? static_cast<int>(std::lround(range.length())) + 1 : 256;
    table->SetNumberOfTableValues(count);
    if (ofKinds)
        table->SetRange(range.low - 0.5, range.high + 0.5);
    else
        table->SetRange(range.low, range.high);
    for (int i = 0; i < count; ++i) {
        const Colour c = ofKinds ? colourOfKind(static_cast<int>(std::lround(range.low)) + i)
                                 : colourAt(style.colours == Colours::aboutZero ? std::span<const Colour>(coolWarm)
                                                                                : std::span<const Colour>(viridis),
                                            i / 255.0);
        table->SetTableValue(i, c[0], c[1], c[2]);
    }
    table->SetNanColor(0.6, 0.6, 0.6, 1);
    return table;
}

std::vector<double> perTriangle(const io::PolyData& surface, const std::vector<double>& ofPoints) {
    std::vector<double> numbers;
    numbers.reserve(surface.triangles.size());
    for (const auto& t : surface.triangles)
        numbers.push_back(std::max({ofPoints[t[0]], ofPoints[t[1]], ofPoints[t[2]]}));
    return numbers;
}

}  // namespace

FieldStyle styleOf(const std::string& field) {
    const Dimension newtonPerMetre = unit::newtonPerMetre;
    if (field == "areaStrain") return {Colours::aboutZero, "area strain", unit::none, true};
    if (field == "tension1") return {Colours::sequential, "tension T\u2081", newtonPerMetre};
    if (field == "tension2") return {Colours::sequential, "tension T\u2082", newtonPerMetre};
    if (field == "stretch") return {Colours::sequential, "stretch", unit::none};
    if (field == "force") return {Colours::sequential, "force", unit::newton};
    if (field == "damage") return {Colours::sequential, "damage", unit::none};
    if (field == "pores") return {Colours::sequential, "share of pores", unit::none, true};
    if (field == "concentration") return {Colours::sequential, "concentration", unit::kilogramPerMetre3};
    if (field == "spacing") return {Colours::sequential, "spacing", unit::metre};
    if (field == "velocity" || field == "speed") return {Colours::sequential, "speed", unit::metrePerSecond};
    if (field == "u" || field == "v" || field == "w")
        return {Colours::signedOrNot, "velocity " + field, unit::metrePerSecond};
    if (field == "pressure") return {Colours::signedOrNot, "pressure", unit::pascal};
    if (field == "meanPressure") return {Colours::signedOrNot, "mean pressure", unit::pascal};
    if (field == "density") return {Colours::sequential, "density", unit::kilogramPerMetre3};
    if (field == "broken") return {Colours::kinds, "triangles", unit::none, false, {"whole", "broken"}};
    if (field == "hole") return {Colours::kinds, "hole", unit::none};
    if (field == "side") return {Colours::kinds, "cell", unit::none, false, {"outside"}};
    return {Colours::sequential, field, unit::none};
}

Values valuesOf(const io::PolyData& surface, const std::string& name, const std::string& field) {
    const bool ofKinds = styleOf(field).colours == Colours::kinds;
    for (const bool ofCells : {true, false}) {
        const io::Arrays& arrays = ofCells ? surface.cell : surface.point;
        std::vector<double> numbers;
        if (const auto scalars = arrays.scalars.find(field); scalars != arrays.scalars.end())
            numbers = scalars->second;
        else if (const auto integers = arrays.integers.find(field); integers != arrays.integers.end())
            numbers.assign(integers->second.begin(), integers->second.end());
        else if (const auto vectors = arrays.vectors.find(field); vectors != arrays.vectors.end())
            for (const Vec3& v : vectors->second) numbers.push_back(v.norm());
        else
            continue;
        if (ofKinds && !ofCells) return {perTriangle(surface, numbers), true};
        return {std::move(numbers), ofCells};
    }
    auto names = surface.cell.names();
    const auto ofPoints = surface.point.names();
    names.insert(names.end(), ofPoints.begin(), ofPoints.end());
    throw Failure(ExitCode::usage, fmt::format("-field {}: '{}' has no such array; there are: {}{}none.{}", field, name,
                                               joinWords(names), names.empty() ? "" : ", ", didYouMean(field, names)));
}

Scale makeScale(const FieldStyle& style, ValueRange found, const std::optional<ValueRange>& asked) {
    Scale scale{style, asked.value_or(found), 1, "", nullptr};
    ValueRange& range = scale.range;
    if (range.empty()) range = {0, 0};
    if (style.colours == Colours::signedOrNot) {
        constexpr double little = 0.05;
        const bool bothSigns = range.low < -little * range.high && range.high > -little * range.low;
        scale.style.colours = bothSigns ? Colours::aboutZero : Colours::sequential;
        if (!bothSigns && !asked) (range.high > -range.low ? range.low : range.high) = 0;
    }
    if (scale.style.colours == Colours::kinds) {
        range.low = std::floor(std::min(range.low, 0.0));
        range.high =
            std::min(std::ceil(std::max(range.high, static_cast<double>(style.names.size()) - 1)), range.low + 1e3);
    } else if (!asked) {
        if (scale.style.colours == Colours::aboutZero) {
            range.high = std::max(std::abs(range.low), std::abs(range.high));
            range.low = -range.high;
        }
        if (range.length() <= 1e-12 * std::max(std::abs(range.low), std::abs(range.high)) || range.length() == 0) {
            const double margin = range.low == 0 ? (style.percent ? 0.01 : 1) : 0.1 * std::abs(range.low);
            if (range.low != 0 || scale.style.colours == Colours::aboutZero) range.low -= margin;
            range.high += margin;
        }
    }
    std::string unit;
    if (style.percent) {
        unit = "%";
        scale.perUnit = 0.01;
    } else {
        std::tie(unit, scale.perUnit) = unitFor(range, style.dimension);
    }
    scale.title = unit.empty() ? style.title : style.title + ", " + unit;
    scale.colours = colourTable(scale.style, range);
    return scale;
}

ValueRange parseRange(const std::string& option, const std::string& text) {
    const std::size_t comma = text.find(',');
    try {
        if (comma == std::string::npos) throw std::invalid_argument("there is no comma");
        const Quantity low = parseQuantity(text.substr(0, comma)), high = parseQuantity(text.substr(comma + 1));
        // In "0,20 uN/m" the unit applies to both numbers.
        const double factor =
            high.hasUnit && !low.hasUnit
                ? parseQuantity("1 " + text.substr(text.find_first_not_of(" +-.0123456789eE", comma + 1))).value
                : 1;
        const ValueRange range{low.value * factor, high.value};
        if (!(range.length() > 0) || !std::isfinite(range.length()))
            throw std::invalid_argument("the second must be greater than the first");
        return range;
    } catch (const std::invalid_argument& error) {
        throw Failure(ExitCode::usage, fmt::format("{} {}: LOW,HIGH is expected, in SI or with a unit (like -0.05,0.05 "
                                                   "or '0,20 uN/m'): {}.",
                                                   option, text, error.what()));
    }
}

}  // namespace corpuscle
