#include "overlay.hpp"

#include <fmt/format.h>
#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace corpuscle {
namespace {

// VTK's own font has no dotted Greek letter; DejaVu has. Without DejaVu, labels use Latin letters only.
constexpr const char* fontFile = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

bool hasFont() { return std::filesystem::exists(fontFile); }

std::string plain(std::string words) {
    const std::pair<std::string, std::string> spelling[] = {
        {"\u03b3\u0307t", "strain"}, {"\u2009", " "}, {"\u2081", "1"}, {"\u2082", "2"}};
    for (const auto& [from, to] : spelling) {
        for (auto at = words.find(from); at != std::string::npos; at = words.find(from, at))
            words.replace(at, from.size(), to);
    }
    return words;
}

std::string shown(const std::string& words) { return hasFont() ? words : plain(words); }

void setFont(vtkTextProperty* property, double size) {
    if (hasFont()) {
        property->SetFontFamily(VTK_FONT_FILE);
        property->SetFontFile(fontFile);
    } else {
        property->SetFontFamilyToArial();
    }
    property->SetColor(0, 0, 0);
    property->SetFontSize(std::max(1, static_cast<int>(std::lround(size))));
}

constexpr int mostKinds = 7;  // shown on a bar

struct Tick {
    double place;  // position along the bar, 0 to 1
    std::string words;
};
std::vector<Tick> ticksOf(const Scale& scale) {
    std::vector<Tick> ticks;
    const ValueRange& range = scale.range;
    if (scale.style.colours == FieldStyle::Colours::kinds) {
        const int count = static_cast<int>(std::lround(range.length())) + 1, shownCount = std::min(count, mostKinds);
        for (int i = 0; i < shownCount; ++i) {
            const int kind = static_cast<int>(std::lround(range.low)) + i;
            const auto index = static_cast<std::size_t>(std::max(kind, 0));
            const std::string name = index < scale.style.names.size() ? scale.style.names[index]
                                     : kind == 0                      ? "none"
                                                                      : fmt::format("{}", kind);
            ticks.push_back(
                {(i + 0.5) / shownCount, i + 1 == mostKinds && count > mostKinds ? name + " \u2026" : name});
        }
        return ticks;
    }
    for (int i = 0; i <= 2; ++i) {
        const double value = (range.low + range.length() * i / 2) / scale.perUnit;
        const double tiny = 1e-9 * range.length() / scale.perUnit;
        // Enough digits to distinguish the two ends; no powers of ten for numbers of up to five digits.
        const double largest = std::max(std::abs(range.low), std::abs(range.high));
        const int apart = 3 + static_cast<int>(std::ceil(std::log10(largest / range.length())));
        const int whole = 1 + static_cast<int>(std::floor(std::log10(std::max(largest / scale.perUnit, 1.0))));
        ticks.push_back({i / 2.0, fmt::format("{:.{}g}", std::abs(value) < tiny ? 0.0 : value,
                                              std::clamp(std::max(apart, whole <= 5 ? whole : 3), 3, 10))});
    }
    return ticks;
}

}  // namespace

double Overlay::widthOf(const std::string& words, double height) {
    constexpr double fine = 10;
    vtkNew<vtkTextProperty> property;
    setFont(property, fine * height);
    int box[4] = {0, 0, 0, 0};
    vtkTextRenderer::GetInstance()->GetBoundingBox(property, shown(words), box, 72);
    return (box[1] - box[0]) / fine;
}

void Overlay::text(const std::string& words, double x, double y, double height, Align align) {
    vtkNew<vtkTextActor> actor;
    actor->SetInput(shown(words).c_str());
    vtkTextProperty* property = actor->GetTextProperty();
    setFont(property, height * scale_);
    property->SetVerticalJustificationToCentered();
    property->SetJustification(align == Align::left     ? VTK_TEXT_LEFT
                               : align == Align::centre ? VTK_TEXT_CENTERED
                                                        : VTK_TEXT_RIGHT);
    actor->SetTextScaleModeToNone();
    actor->SetDisplayPosition(static_cast<int>(std::lround(x * scale_)), static_cast<int>(std::lround(y * scale_)));
    renderer_->AddActor2D(actor);
    const double width = widthOf(words, height);
    const double left = align == Align::left ? x : align == Align::centre ? x - 0.5 * width : x - width;
    places_.push_back({words, left, y - 0.5 * height, width, height});
}

void Overlay::polygon(const std::vector<std::array<double, 2>>& corners, const Colour& colour) {
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell(static_cast<int>(corners.size()));
    for (std::size_t i = 0; i < corners.size(); ++i) {
        points->InsertNextPoint(corners[i][0] * scale_, corners[i][1] * scale_, 0);
        cells->InsertCellPoint(static_cast<vtkIdType>(i));
    }
    vtkNew<vtkPolyData> poly;
    poly->SetPoints(points);
    poly->SetPolys(cells);
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(poly);
    vtkNew<vtkActor2D> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
    renderer_->AddActor2D(actor);
}

void Overlay::rectangle(double x, double y, double width, double height, const Colour& colour) {
    polygon({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, colour);
}

void Overlay::line(double x0, double y0, double x1, double y1, double width, const Colour& colour) {
    const double length = std::max(std::hypot(x1 - x0, y1 - y0), 1e-6);
    const double px = -(y1 - y0) / length * width / 2, py = (x1 - x0) / length * width / 2;
    polygon({{x0 - px, y0 - py}, {x1 - px, y1 - py}, {x1 + px, y1 + py}, {x0 + px, y0 + py}}, colour);
}

void Overlay::arrow(double x, double y, double length, double headLength, const Colour& colour) {
    const double head = std::min(headLength, 0.6 * length);
    line(x, y, x + length - head, y, std::max(1.5, 0.2 * headLength), colour);
    polygon({{x + length - head, y - 0.42 * head}, {x + length, y}, {x + length - head, y + 0.42 * head}}, colour);
    places_.push_back({"arrow", x, y - 0.4 * head, length, 0.8 * head});
}

double Overlay::barWidthOf(const Scale& scale, const std::vector<std::string>& title, double textHeight) {
    double width = 0;
    for (const std::string& line : title) width = std::max(width, widthOf(line, textHeight));
    for (const Tick& tick : ticksOf(scale)) width = std::max(width, 2 * textHeight + widthOf(tick.words, textHeight));
    return width;
}

void Overlay::colourBar(double x, double y, double wholeHeight, const Scale& scale,
                        const std::vector<std::string>& title, double textHeight) {
    const Colour grey{0.3, 0.3, 0.3};
    const double width = 1.3 * textHeight, lineHeight = 1.35 * textHeight;
    y += 0.6 * textHeight;  // half the height of a number
    const double height = wholeHeight - 1.6 * textHeight - lineHeight * static_cast<double>(title.size());
    const auto ticks = ticksOf(scale);
    const bool ofKinds = scale.style.colours == FieldStyle::Colours::kinds;
    const int steps = ofKinds ? static_cast<int>(ticks.size()) : 64;
    for (const double edge : {x - 1, x + width}) rectangle(edge, y - 1, 1, height + 2, grey);
    for (const double edge : {y - 1, y + height}) rectangle(x, edge, width, 1, grey);
    for (int i = 0; i < steps; ++i) {
        Colour colour{};
        const double value = ofKinds ? scale.range.low + i : scale.range.low + scale.range.length() * (i + 0.5) / steps;
        scale.colours->GetColor(value, colour.data());
        rectangle(x, y + height * i / steps, width, height / steps, colour);
    }
    places_.push_back({"bar " + title.front(), x - 1, y - 1, width + 2, height + 2});
    for (const Tick& tick : ticks) text(tick.words, x + width + 0.5 * textHeight, y + height * tick.place, textHeight);
    for (std::size_t i = 0; i < title.size(); ++i)
        text(title[i], x, y + height + 0.6 * textHeight + lineHeight * (static_cast<double>(title.size() - i) - 0.5),
             textHeight);
}

double roundBelow(double limit) {
    const double power = std::pow(10.0, std::floor(std::log10(limit)));
    const double factor = limit / power;
    return power * (factor >= 5 ? 5 : factor >= 2 ? 2 : 1);
}

}  // namespace corpuscle
