#include "overlay.hpp"

#include <fmt/format.h>
#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <cmath>
#include <filesystem>

namespace corpuscle {
namespace {

// VTK's own font has no Greek letter with a dot; DejaVu has. Without it labels are spelt in plain letters.
constexpr const char* fontFile = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

bool hasFont() { return std::filesystem::exists(fontFile); }

std::string plain(std::string words) {
    const std::pair<std::string, std::string> spelling[] = {
        {"\u03b3\u0307", "strain "}, {"\u2009", " "}, {"\u2081", "1"}, {"\u2082", "2"}};
    for (const auto& [from, to] : spelling) {
        for (auto at = words.find(from); at != std::string::npos; at = words.find(from, at))
            words.replace(at, from.size(), to);
    }
    return words;
}

}  // namespace

void Overlay::text(const std::string& words, double x, double y, double height, Align align) {
    vtkNew<vtkTextActor> actor;
    actor->SetInput(hasFont() ? words.c_str() : plain(words).c_str());
    vtkTextProperty* property = actor->GetTextProperty();
    if (hasFont()) {
        property->SetFontFamily(VTK_FONT_FILE);
        property->SetFontFile(fontFile);
    } else {
        property->SetFontFamilyToArial();
    }
    property->SetColor(0, 0, 0);
    property->SetFontSize(static_cast<int>(std::lround(height * scale_)));
    property->SetVerticalJustificationToCentered();
    property->SetJustification(align == Align::left     ? VTK_TEXT_LEFT
                               : align == Align::centre ? VTK_TEXT_CENTERED
                                                        : VTK_TEXT_RIGHT);
    actor->SetTextScaleModeToNone();
    actor->SetDisplayPosition(static_cast<int>(std::lround(x * scale_)), static_cast<int>(std::lround(y * scale_)));
    renderer_->AddActor2D(actor);
}

void Overlay::rectangle(double x, double y, double width, double height, const Colour& colour) {
    vtkNew<vtkPoints> points;
    for (const auto& [dx, dy] : {std::pair{0.0, 0.0}, {width, 0.0}, {width, height}, {0.0, height}}) {
        points->InsertNextPoint((x + dx) * scale_, (y + dy) * scale_, 0);
    }
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell({0, 1, 2, 3});
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

void Overlay::colourBar(double x, double y, double width, double height, vtkLookupTable* colours, double perUnit,
                        const std::string& title, double textHeight) {
    constexpr int steps = 64;
    const double* range = colours->GetRange();
    const Colour grey{0.3, 0.3, 0.3};
    for (const double edge : {x - 1, x + width}) rectangle(edge, y - 1, 1, height + 2, grey);
    for (const double edge : {y - 1, y + height}) rectangle(x, edge, width, 1, grey);
    for (int i = 0; i < steps; ++i) {
        Colour colour{};
        colours->GetColor(range[0] + (range[1] - range[0]) * (i + 0.5) / steps, colour.data());
        rectangle(x, y + height * i / steps, width, height / steps, colour);
    }
    for (int i = 0; i <= 2; ++i) {
        const double value = (range[0] + (range[1] - range[0]) * i / 2) / perUnit;
        text(fmt::format("{:.3g}", std::abs(value) < 1e-12 * (range[1] - range[0]) / perUnit ? 0.0 : value),
             x + width + 6, y + height * i / 2, textHeight);
    }
    text(title, x, y + height + 1.5 * textHeight, textHeight);
}

double roundBelow(double limit) {
    const double power = std::pow(10.0, std::floor(std::log10(limit)));
    const double factor = limit / power;
    return power * (factor >= 5 ? 5 : factor >= 2 ? 2 : 1);
}

}  // namespace corpuscle
