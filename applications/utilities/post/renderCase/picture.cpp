#include "picture.hpp"

#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkImageShrink3D.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

#include "actors.hpp"
#include "core/error.hpp"
#include "io/publish.hpp"
#include "offscreenWindow.hpp"

namespace corpuscle {
namespace {

constexpr int oversampling = 3;    // drawn at three times the size, then averaged: smooth outlines, thin edges
constexpr int mostInRow = 5;       // panels
constexpr double leastText = 8.5;  // pixels

// 1.5, 2.05: one decimal if the second would be 0, otherwise two.
std::string strainWords(double strain) {
    const double tenths = 10 * strain;
    return fmt::format("{:.{}f}", strain, std::abs(tenths - std::round(tenths)) < 0.05 ? 1 : 2);
}

std::string labelOf(const Frame& frame, const Plan& plan) {
    if (frame.strain && !plan.options.labelTime && (*frame.strain != 0 || plan.largestTime > 0))
        return "\u03b3\u0307t = " + strainWords(*frame.strain);
    if (frame.stage) return fmt::format("stage {:g}", *frame.stage);
    if (plan.largestTime == 0) return "t = 0";
    const std::string unit = formatQuantity(plan.largestTime, unit::second);
    const std::string name = unit.substr(unit.find(' ') + 1);
    return fmt::format("t = {:.3g} {}", frame.time / parseQuantity("1 " + name).value, name == "us" ? "\u00b5s" : name);
}

void writePng(vtkImageData* image, const std::filesystem::path& output) {
    vtkNew<vtkImageShrink3D> shrink;
    shrink->SetInputData(image);
    shrink->SetShrinkFactors(oversampling, oversampling, 1);
    shrink->AveragingOn();
    if (output.has_parent_path()) io::makeFolder(output.parent_path());
    const auto temporary = io::temporaryName(output);
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(shrink->GetOutputPort());
    writer->SetFileName(temporary.c_str());
    writer->Write();
    if (writer->GetErrorCode() != 0) throw io::notWritten(output, temporary);
    io::publish(temporary, output, io::Sync::none);
}

std::vector<Vec3> cornersOf(const particles::Box& box) {
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) {
        Vec3 x;
        for (int k = 0; k < 3; ++k) {
            const double wall = box.periodic[k] ? 0 : wallThickness(box);
            x[k] = (i >> k) & 1 ? box.high[k] + wall : box.low[k] - wall;
        }
        corners.push_back(x);
    }
    return corners;
}

Camera cameraFor(const std::vector<Frame>& frames, const PictureOptions& options) {
    std::vector<Vec3> shown;
    for (const Frame& frame : frames) {
        for (const auto& item : frame.surfaces)
            shown.insert(shown.end(), item.second.points.begin(), item.second.points.end());
        if (!options.box)
            for (const DrawnLine& line : frame.streamlines)
                shown.insert(shown.end(), line.course.points.begin(), line.course.points.end());
        if (!frame.slice || (options.frameCells && !shown.empty())) continue;
        for (const int row : {0, frame.slice->rows - 1})
            for (const int column : {0, frame.slice->columns - 1}) shown.push_back(frame.slice->place(column, row));
    }
    if (options.box && (!options.frameCells || shown.empty()))
        for (const Vec3& corner : cornersOf(*options.box)) shown.push_back(corner);
    if (shown.empty())
        throw Failure(ExitCode::io, "there is nothing to draw: the surfaces of the case have no points.");
    return {options.view, shown};
}

std::string lengthWords(double metres) {
    std::string words = formatQuantity(metres, unit::metre, 3);
    if (const auto micro = words.find(" um"); micro != std::string::npos) words.replace(micro, 3, " \u00b5m");
    return words;
}

// Lengths in pixels of the finished picture.
struct Layout {
    double textHeight = 0, labelHeight = 0;
    int columns = 0, rows = 0, panelWidth = 0, imageHeight = 0, labelStrip = 0, bottomStrip = 0, barColumn = 0;
    int width = 0, height = 0, gap = 0;
    double metresPerPixel = 0;
};

using Bars = std::vector<std::pair<const Scale*, std::vector<std::string>>>;

Bars barsOf(const Plan& plan, std::span<const Frame> frames) {
    Bars bars;
    if (plan.field) bars.emplace_back(&*plan.field, std::vector{plan.field->title});
    if (plan.fluid && !frames.front().slice) {
        bars.emplace_back(&*plan.fluid, std::vector{plan.fluid->title});
    } else if (plan.fluid) {
        const Plane& plane = frames.front().slice->plane;
        const double position = std::abs(plane.position) < 1e-12 ? 0 : plane.position;
        bars.emplace_back(&*plan.fluid,
                          std::vector{plan.fluid->title, fmt::format("at {} = {}", plane.axisName(),
                                                                     position == 0 ? "0" : lengthWords(position))});
    }
    return bars;
}

Layout layOut(const Plan& plan, int count, const std::vector<std::string>& labels, const Bars& bars) {
    const PictureOptions& options = plan.options;
    Layout out;
    out.rows = (count + mostInRow - 1) / mostInRow;
    out.columns = (count + out.rows - 1) / out.rows;
    out.width = options.width > 0 ? options.width : std::clamp(520 * out.columns, 800, 1600);
    out.textHeight = std::clamp(out.width / 40.0, 9.0, std::clamp(out.width / 70.0, 14.0, 44.0));
    const auto tooSmall = [&] {
        return Failure(ExitCode::usage,
                       fmt::format("-size {}{}: too small for {} panel{}{}.", out.width,
                                   options.height > 0 ? fmt::format("x{}", options.height) : "", count,
                                   count == 1 ? "" : "s", bars.empty() ? "" : " and their colour bars"));
    };
    double barWidth = 0, leastBars = out.textHeight;
    for (const auto& [scale, title] : bars) {
        barWidth = std::max(barWidth, Overlay::barWidthOf(*scale, title, out.textHeight));
        leastBars += (6.5 + 1.35 * static_cast<double>(title.size())) * out.textHeight;
    }
    out.barColumn = bars.empty() ? 0 : static_cast<int>(std::ceil(barWidth + 2 * out.textHeight));
    out.panelWidth = (out.width - out.barColumn) / out.columns;
    out.gap = std::max(2, out.panelWidth / 60);
    out.labelStrip = static_cast<int>(1.9 * out.textHeight);
    out.bottomStrip = static_cast<int>(4.0 * out.textHeight);
    double widest = 0;
    for (const std::string& label : labels) widest = std::max(widest, Overlay::widthOf(label, out.textHeight));
    out.labelHeight = out.textHeight * std::min(1.0, 0.95 * out.panelWidth / std::max(widest, 1.0));
    const int imageWidth = out.panelWidth - out.gap;
    if (imageWidth < 40 || out.labelHeight < leastText) throw tooSmall();

    constexpr double filled = 0.96;  // fraction of a panel that the contents fill
    const double byWidth = plan.camera.u().length() / (filled * imageWidth);
    const int strips = out.rows * out.labelStrip + out.bottomStrip;
    if (options.height > 0) {
        out.height = options.height;
    } else {
        out.height = strips + out.rows * static_cast<int>(std::ceil(plan.camera.v().length() / (filled * byWidth)));
        out.height = std::max({out.height, static_cast<int>(std::ceil(leastBars)), strips + out.rows * 60});
    }
    out.imageHeight = (out.height - strips) / out.rows;
    if (out.imageHeight < 40 || out.height < leastBars) throw tooSmall();
    out.metresPerPixel = std::max(byWidth, plan.camera.v().length() / (filled * out.imageHeight));
    return out;
}

void aim(vtkCamera* eye, const Camera& camera, const Layout& layout, int imageWidth) {
    const double halfHeight = 0.5 * layout.imageHeight * layout.metresPerPixel;
    const double halfWidth = 0.5 * imageWidth * layout.metresPerPixel;
    const Vec3 focus = camera.focus() * perMetre, place = camera.eye() * perMetre;
    eye->SetFocalPoint(focus.data());
    eye->SetPosition(place.data());
    eye->SetViewUp(camera.view().up.data());
    if (camera.view().perspective)
        eye->SetViewAngle(2 * std::atan(halfHeight / camera.distance()) * 180 / M_PI);
    else
        eye->ParallelProjectionOn();
    eye->SetParallelScale(halfHeight * perMetre);
    eye->SetWindowCenter(camera.u().middle() / halfWidth, camera.v().middle() / halfHeight);
}

// Draws the scale bar, the axes and the reference arrow, from the left below all panels. Returns the right end of what
// was drawn.
double drawLegend(Overlay& overlay, const Plan& plan, const Layout& layout, double lengthPerSpeed) {
    const Colour black{0, 0, 0};
    const double text = layout.textHeight, middle = 0.5 * layout.bottomStrip;
    double x = text;
    const double barMetres = roundBelow(0.35 * layout.panelWidth * layout.metresPerPixel);
    const double barPixels = barMetres / layout.metresPerPixel;
    overlay.rectangle(x, middle - 0.1 * text, barPixels, std::max(2.0, 0.2 * text), black);
    const std::string length = lengthWords(barMetres);
    x += barPixels + 0.5 * text;
    overlay.text(length, x, middle, text);
    x += Overlay::widthOf(length, text) + 2 * text;

    // The axes as seen by the camera.
    const View& view = plan.camera.view();
    std::array<std::array<double, 2>, 3> ends{};
    double left = 0, low = 0, right = 0, high = 0;
    const double reach = 1.5 * text;
    for (int k = 0; k < 3; ++k) {
        ends[k] = {reach * view.right[k], reach * view.up[k]};
        left = std::min(left, ends[k][0]);
        right = std::max(right, ends[k][0]);
        low = std::min(low, ends[k][1]);
        high = std::max(high, ends[k][1]);
    }
    const double x0 = x + 0.8 * text - left, y0 = middle - 0.5 * (low + high);
    for (int k = 0; k < 3; ++k) {
        const auto& [u, v] = ends[k];
        if (std::hypot(u, v) < 0.3 * text) continue;  // this axis points towards the camera
        overlay.line(x0, y0, x0 + u, y0 + v, std::max(1.5, 0.1 * text), black);
        // The letter is placed away from the other axes.
        const auto &a = ends[(k + 1) % 3], &b = ends[(k + 2) % 3];
        const double du = u - 0.25 * (a[0] + b[0]), dv = v - 0.25 * (a[1] + b[1]);
        const double size = std::max(std::hypot(du, dv), 1e-6);
        overlay.text(std::string(1, "xyz"[k]), x0 + u + 0.5 * text * du / size, y0 + v + 0.5 * text * dv / size,
                     0.75 * text, Align::centre);
    }
    x = x0 + right + 2.6 * text;

    if (plan.options.arrows && plan.largestSpeed > 0) {
        const double speed = roundBelow(plan.largestSpeed);
        const double pixels = speed * lengthPerSpeed / layout.metresPerPixel;
        std::string words = formatQuantity(speed, unit::metrePerSecond);
        if (const auto micro = words.find(" u"); micro != std::string::npos) words.replace(micro, 2, " \u00b5");
        overlay.arrow(x, middle, pixels, 0.36 * plan.arrowSpacing / layout.metresPerPixel, black);
        x += pixels + 0.6 * text;
        overlay.text(words, x, middle, text);
        x += Overlay::widthOf(words, text);
    }
    return x;
}

}  // namespace

Plan makePlan(const std::vector<Frame>& frames, const PictureOptions& options) {
    Plan plan{options, cameraFor(frames, options), {}, {}, {}, 0, 0, 0};
    if (options.cut) plan.cut = cutFor(*options.cut, plan.camera);
    ValueRange field, fluid;
    bool surfaces = false, showsFluid = false;
    for (const Frame& frame : frames) {
        plan.largestTime = std::max(plan.largestTime, std::abs(frame.time));
        surfaces = surfaces || !frame.surfaces.empty();
        if (options.field != "none")
            for (const auto& [name, surface] : frame.surfaces)
                for (const double value : valuesOf(surface, name, options.field).numbers) field.add(value);
        showsFluid = showsFluid || frame.slice || !frame.streamlines.empty();
        if (!frame.slice) {
            for (const DrawnLine& line : frame.streamlines)
                for (const DrawnLine::Piece& piece : line.pieces)
                    for (const double value : piece.values) fluid.add(value);
            continue;
        }
        for (const double value : frame.slice->values) fluid.add(value);
        plan.largestSpeed = std::max(plan.largestSpeed, largestSpeedIn(*frame.slice));
        plan.arrowSpacing = arrowSpacing(*frame.slice);
    }
    if (options.field != "none") {
        if (!surfaces)
            throw Failure(
                ExitCode::usage,
                fmt::format("-field {}: the case has no cells; -fluidField colours the fluid.", options.field));
        plan.field = makeScale(styleOf(options.field), field, options.fieldRange);
    }
    if (showsFluid) plan.fluid = makeScale(styleOf(options.fluidField), fluid, options.fluidRange);
    return plan;
}

namespace {

Panel panelOf(std::size_t number, const Layout& layout) {
    const int row = static_cast<int>(number) / layout.columns, column = static_cast<int>(number) % layout.columns;
    return {column * layout.panelWidth + layout.gap / 2,
            row * (layout.labelStrip + layout.imageHeight) + layout.labelStrip, layout.panelWidth - layout.gap,
            layout.imageHeight};
}

bool isSlicedInCut(const Plan& plan, const Frame& frame) {
    return plan.cut && frame.slice && frame.slice->plane.axis == plan.cut->plane.axis &&
           frame.slice->plane.position == plan.cut->plane.position;
}

// A slice in the plane of the cut has holes through which the inside of the cells is seen.
void drawSlice(vtkRenderer* renderer, const Plan& plan, const Frame& frame, double lengthPerSpeed) {
    Slice slice = *frame.slice;
    std::vector<double> distances;
    if (isSlicedInCut(plan, frame)) {
        distances = distancesFrom(frame.surfaces, slice);
        for (std::size_t i = 0; i < slice.velocity.size(); ++i)
            if (distances[i] < 0) slice.velocity[i].setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    addSlice(renderer, slice, *plan.fluid, distances);
    if (plan.options.arrows) addArrows(renderer, slice, plan.camera, plan.arrowSpacing, lengthPerSpeed);
}

// Two layers: a slice that is not in the plane of the cut lies in the back one, so that it does not hide half of a cell
// through which it passes.
void drawPanel(vtkRenderWindow* window, const Plan& plan, const Frame& frame, const Panel& panel, const Layout& layout,
               double lengthPerSpeed) {
    const PictureOptions& options = plan.options;
    const double low = layout.height - panel.y - panel.height;
    vtkNew<vtkRenderer> back, front;
    front->SetLayer(1);
    for (vtkRenderer* renderer : {back.Get(), front.Get()}) {
        renderer->SetBackground(1, 1, 1);
        renderer->SetViewport(static_cast<double>(panel.x) / layout.width, low / layout.height,
                              static_cast<double>(panel.x + panel.width) / layout.width,
                              (low + panel.height) / layout.height);
        addLights(renderer);
    }
    const Cut* const cut = plan.cut ? &*plan.cut : nullptr;
    const double lineRadius = 1.6 * layout.metresPerPixel;
    if (options.box && !options.frameCells) {
        addBox(back, front, *options.box, plan.camera, layout.metresPerPixel, !options.walls.exist(), cut);
        addWalls(back, front, *options.box, options.walls, cut, lineRadius);
    }
    if (frame.slice) drawSlice(isSlicedInCut(plan, frame) ? front : back, plan, frame, lengthPerSpeed);
    // On a slice of the same colours lines are plain.
    if (!frame.streamlines.empty())
        addStreamlines(front, frame.streamlines, frame.slice ? nullptr : &*plan.fluid, lineRadius);
    for (const auto& [name, surface] : frame.surfaces)
        addSurface(front, surface, name,
                   {options.field, plan.field ? &*plan.field : nullptr, options.mesh, cut, lineRadius});
    for (vtkRenderer* renderer : {back.Get(), front.Get()}) {
        aim(renderer->GetActiveCamera(), plan.camera, layout, panel.width);
        renderer->ResetCameraClippingRange();
        window->AddRenderer(renderer);
    }
}

// Draws what is below the panels and to their right.
void drawMargins(Overlay& overlay, const Plan& plan, const Bars& bars, const Layout& layout, double lengthPerSpeed) {
    if (drawLegend(overlay, plan, layout, lengthPerSpeed) > layout.width - layout.barColumn)
        throw Failure(ExitCode::usage,
                      fmt::format("-size {}: too small for the scale bar and its words.", layout.width));
    const double each =
        (layout.height - layout.textHeight) / static_cast<double>(std::max<std::size_t>(bars.size(), 1));
    for (std::size_t i = 0; i < bars.size(); ++i)
        overlay.colourBar(layout.panelWidth * layout.columns + layout.textHeight,
                          0.5 * layout.textHeight + each * static_cast<double>(bars.size() - 1 - i),
                          std::min(each - 0.5 * layout.textHeight, 22 * layout.textHeight), *bars[i].first,
                          bars[i].second, layout.textHeight);
}

}  // namespace

Picture drawPicture(const Plan& plan, std::span<const Frame> frames, const std::filesystem::path& output) {
    std::vector<std::string> labels;
    for (const Frame& frame : frames) labels.push_back(labelOf(frame, plan));
    const Bars bars = barsOf(plan, frames);
    const Layout layout = layOut(plan, static_cast<int>(frames.size()), labels, bars);

    Picture picture;
    picture.width = layout.width;
    picture.height = layout.height;
    picture.metresPerPixel = layout.metresPerPixel;

    OffscreenWindow offscreen(picture.width * oversampling, picture.height * oversampling);
    offscreen.window()->SetNumberOfLayers(3);
    vtkNew<vtkRenderer> paper;
    paper->SetBackground(1, 1, 1);
    offscreen.window()->AddRenderer(paper);
    vtkNew<vtkRenderer> overlayRenderer;
    overlayRenderer->SetLayer(2);
    overlayRenderer->InteractiveOff();
    Overlay overlay(overlayRenderer, oversampling);

    const double lengthPerSpeed = plan.largestSpeed > 0 ? 0.95 * plan.arrowSpacing / plan.largestSpeed : 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Panel panel = panelOf(i, layout);
        picture.panels.push_back(panel);
        drawPanel(offscreen.window(), plan, frames[i], panel, layout, lengthPerSpeed);
        overlay.text(labels[i], panel.x + 0.5 * panel.width, picture.height - panel.y + 0.5 * layout.labelStrip,
                     layout.labelHeight, Align::centre);
    }
    drawMargins(overlay, plan, bars, layout, lengthPerSpeed);
    offscreen.window()->AddRenderer(overlayRenderer);

    writePng(offscreen.render(), output);
    picture.places = overlay.places();
    return picture;
}

}  // namespace corpuscle
