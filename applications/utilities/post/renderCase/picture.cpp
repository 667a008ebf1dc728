#include "picture.hpp"

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageShrink3D.h>
#include <vtkLight.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRegularPolygonSource.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "io/publish.hpp"
#include "offscreenWindow.hpp"
#include "overlay.hpp"

namespace corpuscle {
namespace {

constexpr int oversampling = 3;  // drawn three times as large and averaged: smooth outlines, thin edges

// How a field is shown: what the numbers are divided by, their title, and whether zero is the middle.
struct FieldStyle {
    double perUnit;
    std::string title;
    bool aboutZero;
};
FieldStyle styleOf(const std::string& field) {
    if (field == "areaStrain") return {0.01, "area strain, %", true};
    if (field == "tension1") return {1e-6, "tension T\u2081, \u00b5N/m", false};
    if (field == "tension2") return {1e-6, "tension T\u2082, \u00b5N/m", false};
    if (field == "stretch") return {1, "stretch", false};
    if (field == "force") return {1e-12, "force, pN", false};
    return {1, field, false};
}

// One number for each triangle or point; empty where the surface has no such array.
struct Values {
    std::vector<double> numbers;
    bool ofCells = false;
};
Values valuesOf(const io::PolyData& surface, const std::string& field) {
    if (const auto found = surface.cell.scalars.find(field); found != surface.cell.scalars.end())
        return {found->second, true};
    if (const auto found = surface.point.scalars.find(field); found != surface.point.scalars.end())
        return {found->second, false};
    Values values;
    if (const auto found = surface.point.vectors.find(field); found != surface.point.vectors.end()) {
        for (const Vec3& v : found->second) values.numbers.push_back(v.norm());
        return values;
    }
    auto names = surface.cell.names();
    const auto ofPoints = surface.point.names();
    names.insert(names.end(), ofPoints.begin(), ofPoints.end());
    throw Failure(ExitCode::usage, fmt::format("-field {}: the membrane has no such array; there are: {}, none.{}",
                                               field, joinWords(names), didYouMean(field, names)));
}

struct Range {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    void add(double value) {
        if (!std::isfinite(value)) return;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    void makeSymmetric() {
        high = std::max(std::abs(low), std::abs(high));
        low = -high;
    }
    void makeWide() {
        if (high > low) return;
        const double margin = low == 0 ? 1 : 0.1 * std::abs(low);
        high = low + margin;
        low -= margin;
    }
};

vtkSmartPointer<vtkLookupTable> colourTable(std::span<const Colour> anchors, Range range) {
    range.makeWide();
    auto table = vtkSmartPointer<vtkLookupTable>::New();
    table->SetNumberOfTableValues(256);
    table->SetRange(range.low, range.high);
    for (int i = 0; i < 256; ++i) {
        const Colour c = colourAt(anchors, i / 255.0);
        table->SetTableValue(i, c[0], c[1], c[2]);
    }
    table->SetNanColor(0.6, 0.6, 0.6, 1);
    return table;
}

vtkSmartPointer<vtkDoubleArray> numbersArray(const std::vector<double>& numbers) {
    auto array = vtkSmartPointer<vtkDoubleArray>::New();
    array->SetName("shown");
    for (const double number : numbers) array->InsertNextValue(number);
    return array;
}

// Micrometres inside VTK: its near planes and tolerances are made for numbers around one.
constexpr double perMetre = 1e6;

vtkSmartPointer<vtkPoints> pointsOf(const std::vector<Vec3>& positions) {
    auto points = vtkSmartPointer<vtkPoints>::New();
    points->SetDataTypeToDouble();
    for (const Vec3& x : positions) points->InsertNextPoint(x[0] * perMetre, x[1] * perMetre, x[2] * perMetre);
    return points;
}

// Outside and inside as two actors: the inside, seen through a hole, is plain and dark, whatever the field.
void addSurface(vtkRenderer* renderer, const io::PolyData& surface, const std::string& field, vtkLookupTable* colours) {
    vtkNew<vtkPolyData> poly;
    poly->SetPoints(pointsOf(surface.points));
    vtkNew<vtkCellArray> cells;
    for (const auto& t : surface.triangles) cells->InsertNextCell({t[0], t[1], t[2]});
    poly->SetPolys(cells);
    if (colours) {
        const Values values = valuesOf(surface, field);
        vtkDataSetAttributes* target =
            values.ofCells ? static_cast<vtkDataSetAttributes*>(poly->GetCellData()) : poly->GetPointData();
        target->SetScalars(numbersArray(values.numbers));
    }
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputData(poly);
    normals->SplittingOff();
    normals->ConsistencyOff();
    for (const bool outside : {true, false}) {
        vtkNew<vtkPolyDataMapper> mapper;
        mapper->SetInputConnection(normals->GetOutputPort());
        mapper->SetScalarVisibility(outside && colours);
        if (colours) {
            mapper->SetLookupTable(colours);
            mapper->UseLookupTableScalarRangeOn();
        }
        vtkNew<vtkActor> actor;
        actor->SetMapper(mapper);
        vtkProperty* property = actor->GetProperty();
        property->SetInterpolationToPhong();
        property->SetBackfaceCulling(outside);
        property->SetFrontfaceCulling(!outside);
        if (outside) {
            property->SetColor(0.84, 0.30, 0.26);
            property->SetAmbient(colours ? 0.60 : 0.28);
            property->SetDiffuse(colours ? 0.42 : 0.75);
            property->SetSpecular(colours ? 0 : 0.12);
            property->SetSpecularPower(25);
            property->EdgeVisibilityOn();
            property->SetEdgeColor(0.25, 0.12, 0.12);
        } else {
            property->SetColor(0.33, 0.13, 0.12);
            property->SetAmbient(0.4);
            property->SetDiffuse(0.6);
        }
        renderer->AddActor(actor);
    }
}

// The fluid particles around the plane through `centre`, as discs in that plane. A slab of 1.5 spacings and discs large
// enough to meet across the diagonal leave no gaps in a disordered fluid.
struct Slab {
    std::vector<Vec3> positions;
    std::vector<double> speeds;  // along x, the direction of flow [m/s]
    double spacing = 0;
};
Slab slabOf(const io::PolyData& fluid, const View& view, const Vec3& centre) {
    Slab slab;
    const auto& velocity = fluid.point.vector("velocity");
    const auto& spacing = fluid.point.scalar("spacing");
    for (std::size_t i = 0; i < fluid.points.size(); ++i) {
        const double above = (fluid.points[i] - centre).dot(view.slab);
        if (std::abs(above) > 0.75 * spacing[i]) continue;
        slab.positions.push_back(fluid.points[i] - above * view.slab);
        slab.speeds.push_back(velocity[i].x());
        slab.spacing = std::max(slab.spacing, spacing[i]);
    }
    return slab;
}

vtkSmartPointer<vtkActor> slabActor(const Slab& slab, const View& view, vtkLookupTable* colours) {
    vtkNew<vtkPolyData> poly;
    poly->SetPoints(pointsOf(slab.positions));
    poly->GetPointData()->SetScalars(numbersArray(slab.speeds));
    vtkNew<vtkRegularPolygonSource> disc;
    disc->SetNumberOfSides(16);
    disc->SetRadius(0.75 * slab.spacing * perMetre);
    disc->SetNormal(view.slab[0], view.slab[1], view.slab[2]);
    disc->GeneratePolylineOff();
    vtkNew<vtkGlyph3DMapper> mapper;
    mapper->SetInputData(poly);
    mapper->SetSourceConnection(disc->GetOutputPort());
    mapper->ScalingOff();
    mapper->SetLookupTable(colours);
    mapper->UseLookupTableScalarRangeOn();
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    return actor;
}

Vec3 centreOf(const Frame& frame) {  // of the box around the cells
    Range box[3];
    for (const auto& item : frame.surfaces) {
        for (const Vec3& x : item.second.points) {
            for (int k = 0; k < 3; ++k) box[k].add(x[k]);
        }
    }
    return 0.5 * Vec3(box[0].low + box[0].high, box[1].low + box[1].high, box[2].low + box[2].high);
}

// What a frame occupies in the picture's plane.
struct Extent {
    Range u, v;
    void add(const std::vector<Vec3>& points, const View& view) {
        for (const Vec3& x : points) {
            u.add(x.dot(view.right));
            v.add(x.dot(view.up));
        }
    }
};

// One decimal where that tells the strains exactly, otherwise two.
std::string labelOf(const Frame& frame) {
    if (frame.strain) {
        const double tenths = 10 * *frame.strain;
        return fmt::format("\u03b3\u0307t = {:.{}f}", *frame.strain,
                           std::abs(tenths - std::round(tenths)) < 0.05 ? 1 : 2);
    }
    if (frame.stage) return fmt::format("stage {:g}", *frame.stage);
    return fmt::format("t = {:.4g} ms", frame.time * 1e3);
}

void addLights(vtkRenderer* renderer) {
    auto add = [&](double x, double y, double z, double intensity) {
        vtkNew<vtkLight> light;
        light->SetLightTypeToCameraLight();
        light->SetPosition(x, y, z);
        light->SetIntensity(intensity);
        renderer->AddLight(light);
    };
    renderer->AutomaticLightCreationOff();
    add(-0.5, 0.7, 1.0, 0.75);
    add(0.6, -0.1, 1.0, 0.40);
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
    if (writer->GetErrorCode() != 0)
        throw Failure(ExitCode::io, fmt::format("cannot write {}; check permissions and free space.", output.string()));
    io::publish(temporary, output, io::Sync::none);
}

}  // namespace

const std::vector<View>& views() {
    static const std::vector<View> all{
        {"xz", Vec3::UnitX(), Vec3::UnitZ(), Vec3::UnitY()},
        {"xy", Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()},
        {"yz", Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()},
        {"iso", Vec3(2, 1, 0).normalized(), Vec3(-1, 2, 4).normalized(), Vec3::UnitY()},
    };
    return all;
}

Picture drawPicture(const std::vector<Frame>& frames, const PictureOptions& options,
                    const std::filesystem::path& output) {
    const View& view = options.view;
    const bool hasField = options.field != "none";
    const int count = static_cast<int>(frames.size());

    // 1. What is shown: one scale and one range of colours for all panels.
    std::vector<Vec3> centres;
    std::vector<Extent> extents;
    std::vector<Slab> slabs;
    Range fieldRange, speedRange;
    double width = 0, height = 0;  // m
    for (const auto& frame : frames) {
        centres.push_back(centreOf(frame));
        Extent extent;
        for (const auto& item : frame.surfaces) extent.add(item.second.points, view);
        if (frame.fluid) {
            slabs.push_back(slabOf(*frame.fluid, view, centres.back()));
            extent.add(slabs.back().positions, view);
            for (const double speed : slabs.back().speeds) speedRange.add(speed);
        }
        width = std::max(width, extent.u.high - extent.u.low);
        height = std::max(height, extent.v.high - extent.v.low);
        extents.push_back(extent);
        if (hasField) {
            for (const auto& item : frame.surfaces) {
                for (const double value : valuesOf(item.second, options.field).numbers) fieldRange.add(value);
            }
        }
    }
    const FieldStyle style = styleOf(options.field);
    if (style.aboutZero) fieldRange.makeSymmetric();
    speedRange.makeSymmetric();
    const auto fieldColours =
        hasField ? colourTable(style.aboutZero ? std::span<const Colour>(coolWarm) : viridis, fieldRange) : nullptr;
    const auto speedColours = slabs.empty() ? nullptr : colourTable(coolWarm, speedRange);

    // 2. The layout, in pixels of the finished picture.
    Picture picture;
    picture.width = options.width;
    const int bars = (hasField ? 1 : 0) + (slabs.empty() ? 0 : 1);
    const double textHeight = std::clamp(options.width / 80.0, 11.0, 40.0);
    const int barSpace = bars > 0 ? static_cast<int>(11 * textHeight) : 0;
    const int panelWidth = (options.width - barSpace) / count;
    const double margin = 0.06 * panelWidth;
    const int top = static_cast<int>(2.2 * textHeight), bottom = static_cast<int>(2.6 * textHeight);
    const double metresPerPixelWide = width / (panelWidth - 2 * margin);
    picture.height =
        options.height > 0 ? options.height : static_cast<int>(height / metresPerPixelWide + top + bottom + margin);
    if (bars > 0 && options.height == 0)
        picture.height = std::max(picture.height, static_cast<int>(9 * textHeight) * bars + top);
    if (panelWidth < 40 || picture.height < top + bottom + 40) {
        throw Failure(ExitCode::usage,
                      fmt::format("-size {}x{} is too small for {} panels.", options.width, picture.height, count));
    }
    picture.metresPerPixel = std::max(metresPerPixelWide, height / (picture.height - top - bottom - 0.5 * margin));

    // 3. The panels.
    OffscreenWindow offscreen(picture.width * oversampling, picture.height * oversampling);
    offscreen.window()->SetNumberOfLayers(2);
    vtkNew<vtkRenderer> paper;
    paper->SetBackground(1, 1, 1);
    offscreen.window()->AddRenderer(paper);
    vtkNew<vtkRenderer> overlayRenderer;
    overlayRenderer->SetLayer(1);
    overlayRenderer->InteractiveOff();
    Overlay overlay(overlayRenderer, oversampling);
    for (int i = 0; i < count; ++i) {
        const auto index = static_cast<std::size_t>(i);
        const Frame& frame = frames[index];
        const Panel panel{i * panelWidth, 0, panelWidth, picture.height};
        picture.panels.push_back(panel);
        vtkNew<vtkRenderer> renderer;
        renderer->SetBackground(1, 1, 1);
        renderer->SetViewport(static_cast<double>(panel.x) / picture.width, 0,
                              static_cast<double>(panel.x + panel.width) / picture.width, 1);
        addLights(renderer);
        for (const auto& item : frame.surfaces) addSurface(renderer, item.second, options.field, fieldColours);
        if (frame.fluid) renderer->AddActor(slabActor(slabs[index], view, speedColours));

        const Extent& extent = extents[index];
        const double u = 0.5 * (extent.u.low + extent.u.high);
        const double v = 0.5 * (extent.v.low + extent.v.high) + 0.5 * (top - bottom) * picture.metresPerPixel;
        const Vec3 focus = (u * view.right + v * view.up + centres[index].dot(view.ahead()) * view.ahead()) * perMetre;
        const double halfHeight = 0.5 * picture.height * picture.metresPerPixel * perMetre;
        const Vec3 eye = focus - 10 * halfHeight * view.ahead();
        vtkCamera* camera = renderer->GetActiveCamera();
        camera->ParallelProjectionOn();
        camera->SetFocalPoint(focus.data());
        camera->SetPosition(eye.data());
        camera->SetViewUp(view.up.data());
        camera->SetParallelScale(halfHeight);
        renderer->ResetCameraClippingRange();
        offscreen.window()->AddRenderer(renderer);
        overlay.text(labelOf(frame), panel.x + 0.5 * panel.width, picture.height - 0.5 * top, textHeight,
                     Align::centre);
    }

    // 4. Scale bar and colour bars.
    const Colour black{0, 0, 0};
    const double barMetres = roundBelow(0.4 * panelWidth * picture.metresPerPixel);
    const double barPixels = barMetres / picture.metresPerPixel;
    overlay.rectangle(margin, 0.45 * bottom, barPixels, std::max(2.0, 0.2 * textHeight), black);
    overlay.text(fmt::format("{:g} \u00b5m", barMetres * 1e6), margin + barPixels + 0.5 * textHeight,
                 0.45 * bottom + 0.1 * textHeight, textHeight);
    const double each = (picture.height - 0.5 * top) / std::max(bars, 1);
    const double barX = panelWidth * count + textHeight;
    auto addBar = [&](int place, vtkLookupTable* colours, double perUnit, const std::string& title) {
        overlay.colourBar(barX, picture.height - 0.5 * top - each * (place + 1) + 1.2 * textHeight, 1.1 * textHeight,
                          each - 4.2 * textHeight, colours, perUnit, title, 0.85 * textHeight);
    };
    if (hasField) addBar(0, fieldColours, style.perUnit, style.title);
    if (!slabs.empty()) addBar(bars - 1, speedColours, 1e-3, "velocity u, mm/s");
    offscreen.window()->AddRenderer(overlayRenderer);

    writePng(offscreen.render(), output);
    return picture;
}

}  // namespace corpuscle
