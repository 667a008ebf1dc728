#include "actors.hpp"

#include <vtkActor.h>
#include <vtkAppendPolyData.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkClipPolyData.h>
#include <vtkConeSource.h>
#include <vtkContourFilter.h>
#include <vtkCubeSource.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLineSource.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkTubeFilter.h>

#include <algorithm>
#include <cmath>

namespace corpuscle {
namespace {

vtkSmartPointer<vtkDoubleArray> numbersArray(const std::vector<double>& numbers) {
    auto array = vtkSmartPointer<vtkDoubleArray>::New();
    array->SetName("shown");
    for (const double number : numbers) array->InsertNextValue(number);
    return array;
}

void insert(vtkPoints* points, const Vec3& x) {
    points->InsertNextPoint(x[0] * perMetre, x[1] * perMetre, x[2] * perMetre);
}

vtkSmartPointer<vtkPoints> pointsOf(const std::vector<Vec3>& positions) {
    auto points = vtkSmartPointer<vtkPoints>::New();
    points->SetDataTypeToDouble();
    for (const Vec3& x : positions) insert(points, x);
    return points;
}

vtkSmartPointer<vtkActor> flatActor(vtkPolyData* poly, const Colour& colour) {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(poly);
    mapper->ScalarVisibilityOff();
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
    return actor;
}

void addTubes(vtkRenderer* renderer, vtkPolyData* lines, double radius, const Colour& colour) {
    if (lines->GetNumberOfLines() == 0) return;
    vtkNew<vtkTubeFilter> tubes;
    tubes->SetInputData(lines);
    tubes->SetRadius(radius * perMetre);
    tubes->SetNumberOfSides(8);
    tubes->Update();
    renderer->AddActor(flatActor(tubes->GetOutput(), colour));
}

void colourBy(vtkPolyDataMapper* mapper, const Scale& scale) {
    mapper->SetLookupTable(scale.colours);
    mapper->UseLookupTableScalarRangeOn();
    if (scale.style.colours != FieldStyle::Colours::kinds) mapper->InterpolateScalarsBeforeMappingOn();
}

Vec3 inPlane(Vec3 v, const Plane& plane) {
    v[plane.axis] = 0;
    return v;
}

}  // namespace

void addLights(vtkRenderer* renderer) {
    auto add = [&](double x, double y, double z, double intensity) {
        vtkNew<vtkLight> light;
        light->SetLightTypeToCameraLight();
        light->SetPosition(x, y, z);
        light->SetIntensity(intensity);
        renderer->AddLight(light);
    };
    renderer->AutomaticLightCreationOff();
    add(-0.9, 0.75, 0.6, 0.75);  // from the upper left, so that dimples have a bright and a dark side
    add(0.3, 0.2, 1.0, 0.42);
}

vtkSmartPointer<vtkPolyData> trianglesOf(const io::PolyData& surface) {
    auto poly = vtkSmartPointer<vtkPolyData>::New();
    poly->SetPoints(pointsOf(surface.points));
    vtkNew<vtkCellArray> cells;
    for (const auto& t : surface.triangles) cells->InsertNextCell({t[0], t[1], t[2]});
    poly->SetPolys(cells);
    return poly;
}

// The outer and the inner side are two actors: the inner side, visible through a hole, is plain and dark for every
// field.
void addSurface(vtkRenderer* renderer, const io::PolyData& surface, const std::string& name,
                const SurfaceStyle& style) {
    const auto& [field, scale, mesh, cut, rim] = style;
    const vtkSmartPointer<vtkPolyData> poly = trianglesOf(surface);
    if (scale) {
        const Values values = valuesOf(surface, name, field);
        vtkDataSetAttributes* target =
            values.ofCells ? static_cast<vtkDataSetAttributes*>(poly->GetCellData()) : poly->GetPointData();
        target->SetScalars(numbersArray(values.numbers));
    }
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputData(poly);
    normals->SplittingOff();
    normals->ConsistencyOff();
    normals->Update();
    vtkSmartPointer<vtkPolyData> shown = normals->GetOutput();
    if (cut) {
        addTubes(renderer, rimOf(shown, cut->plane), rim, {0.98, 0.74, 0.66});
        shown = remainder(shown, *cut);
    }
    for (const bool outside : {true, false}) {
        vtkNew<vtkPolyDataMapper> mapper;
        mapper->SetInputData(shown);
        mapper->SetScalarVisibility(outside && scale);
        if (scale) colourBy(mapper, *scale);
        vtkNew<vtkActor> actor;
        actor->SetMapper(mapper);
        vtkProperty* property = actor->GetProperty();
        property->SetInterpolationToPhong();
        property->SetBackfaceCulling(outside);
        property->SetFrontfaceCulling(!outside);
        if (outside) {
            property->SetColor(0.84, 0.30, 0.26);
            property->SetAmbient(scale ? 0.50 : 0.26);
            property->SetDiffuse(scale ? 0.55 : 0.85);
            property->SetSpecular(scale ? 0 : 0.10);
            property->SetSpecularPower(25);
            property->SetEdgeVisibility(mesh);
            property->SetEdgeColor(0.25, 0.12, 0.12);
        } else {
            property->SetColor(0.33, 0.13, 0.12);
            property->SetAmbient(0.4);
            property->SetDiffuse(0.6);
        }
        renderer->AddActor(actor);
    }
}

namespace {

// The part of the slice at positive distances.
vtkSmartPointer<vtkPolyData> outsideOf(vtkPolyData* slice, const std::vector<double>& distances) {
    const auto array = numbersArray(distances);
    array->SetName("distance");
    vtkNew<vtkPolyData> measured;
    measured->ShallowCopy(slice);
    measured->GetPointData()->SetScalars(array);  // replaces the values, which are added again
    measured->GetPointData()->AddArray(slice->GetPointData()->GetScalars());
    vtkNew<vtkClipPolyData> clip;
    clip->SetInputData(measured);
    clip->SetValue(0);
    clip->Update();
    const vtkSmartPointer<vtkPolyData> rest = clip->GetOutput();
    rest->GetPointData()->SetActiveScalars("shown");
    return rest;
}

}  // namespace

void addSlice(vtkRenderer* renderer, const Slice& slice, const Scale& scale, const std::vector<double>& distances) {
    if (slice.columns < 2 || slice.rows < 2) return;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> cells;
    for (int row = 0; row < slice.rows; ++row) {
        for (int column = 0; column < slice.columns; ++column) insert(points, slice.place(column, row));
    }
    for (int row = 0; row + 1 < slice.rows; ++row) {
        for (int column = 0; column + 1 < slice.columns; ++column) {
            const std::array<std::size_t, 4> corners{slice.index(column, row), slice.index(column + 1, row),
                                                     slice.index(column + 1, row + 1), slice.index(column, row + 1)};
            bool whole = true;
            for (const std::size_t corner : corners) whole = whole && std::isfinite(slice.values[corner]);
            if (!whole) continue;
            cells->InsertNextCell(4);
            for (const std::size_t corner : corners) cells->InsertCellPoint(static_cast<vtkIdType>(corner));
        }
    }
    vtkNew<vtkPolyData> poly;
    poly->SetPoints(points);
    poly->SetPolys(cells);
    poly->GetPointData()->SetScalars(numbersArray(slice.values));
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(distances.empty() ? poly.Get() : outsideOf(poly, distances).Get());
    colourBy(mapper, scale);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    renderer->AddActor(actor);
}

double arrowSpacing(const Slice& slice) {
    return std::max(slice.dx * (slice.columns - 1), slice.dy * (slice.rows - 1)) / 9;
}

double largestSpeedIn(const Slice& slice) {
    double largest = 0;
    for (const Vec3& v : slice.velocity) {
        if (v.allFinite()) largest = std::max(largest, inPlane(v, slice.plane).norm());
    }
    return largest;
}

void addArrows(vtkRenderer* renderer, const Slice& slice, const Camera& camera, double spacing, double lengthPerSpeed) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> cells;
    const int stepX = std::max(1, static_cast<int>(std::lround(spacing / slice.dx)));
    const int stepY = std::max(1, static_cast<int>(std::lround(spacing / slice.dy)));
    Vec3 normal = Vec3::Zero();
    normal[slice.plane.axis] = 1;
    if (!camera.seesFromSide(slice.place(0, 0), normal)) normal = -normal;
    for (int row = stepY / 2; row < slice.rows; row += stepY) {
        for (int column = stepX / 2; column < slice.columns; column += stepX) {
            const Vec3 arrow = lengthPerSpeed * inPlane(slice.velocity[slice.index(column, row)], slice.plane);
            const double length = arrow.norm();
            if (!(length > 0.05 * spacing)) continue;
            const Vec3 along = arrow / length, across = normal.cross(along);
            const double half = 0.035 * spacing, head = std::min(0.36 * spacing, 0.6 * length), wide = 0.42 * head;
            const Vec3 tail = slice.place(column, row) - 0.5 * arrow + 0.05 * spacing * normal, tip = tail + arrow,
                       neck = tip - head * along;
            const vtkIdType first = points->GetNumberOfPoints();
            for (const Vec3& x :
                 {Vec3(tail - half * across), Vec3(neck - half * across), Vec3(neck + half * across),
                  Vec3(tail + half * across), Vec3(neck - wide * across), tip, Vec3(neck + wide * across)})
                insert(points, x);
            cells->InsertNextCell({first, first + 1, first + 2, first + 3});
            cells->InsertNextCell({first + 4, first + 5, first + 6});
        }
    }
    vtkNew<vtkPolyData> poly;
    poly->SetPoints(points);
    poly->SetPolys(cells);
    renderer->AddActor(flatActor(poly, {0.08, 0.08, 0.08}));
}

namespace {

vtkSmartPointer<vtkPolyData> linesOf(const std::vector<DrawnLine>& lines) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> cells;
    std::vector<double> values;
    for (const DrawnLine& line : lines) {
        for (const DrawnLine::Piece& piece : line.pieces) {
            cells->InsertNextCell(static_cast<int>(piece.points.size()));
            for (std::size_t i = 0; i < piece.points.size(); ++i) {
                cells->InsertCellPoint(points->GetNumberOfPoints());
                insert(points, piece.points[i]);
                values.push_back(piece.values[i]);
            }
        }
    }
    auto poly = vtkSmartPointer<vtkPolyData>::New();
    poly->SetPoints(points);
    poly->SetLines(cells);
    poly->GetPointData()->SetScalars(numbersArray(values));
    return poly;
}

// A cone on each line, at a quarter of its longest piece, where a cell in the middle of the box does not hide it.
vtkSmartPointer<vtkPolyData> conesOf(const std::vector<DrawnLine>& lines, double radius) {
    vtkNew<vtkAppendPolyData> all;
    for (const DrawnLine& line : lines) {
        if (line.pieces.empty()) continue;
        const auto& piece = *std::max_element(line.pieces.begin(), line.pieces.end(), [](const auto& a, const auto& b) {
            return a.points.size() < b.points.size();
        });
        const std::size_t at = std::max<std::size_t>(piece.points.size() / 4, 1);
        const Vec3 place = piece.points[at] * perMetre, along = piece.points[at] - piece.points[at - 1];
        vtkNew<vtkConeSource> cone;
        cone->SetRadius(3 * radius * perMetre);
        cone->SetHeight(8 * radius * perMetre);
        cone->SetResolution(12);
        cone->SetCenter(place.data());
        cone->SetDirection(along.data());
        cone->Update();
        cone->GetOutput()->GetPointData()->SetScalars(numbersArray(
            std::vector<double>(static_cast<std::size_t>(cone->GetOutput()->GetNumberOfPoints()), piece.values[at])));
        all->AddInputData(cone->GetOutput());
    }
    all->Update();
    return all->GetOutput();
}

}  // namespace

void addStreamlines(vtkRenderer* renderer, const std::vector<DrawnLine>& lines, const Scale* scale, double radius) {
    if (lines.empty()) return;
    vtkNew<vtkTubeFilter> tubes;
    tubes->SetInputData(linesOf(lines));
    tubes->SetRadius(radius * perMetre);
    tubes->SetNumberOfSides(10);
    tubes->CappingOn();
    tubes->Update();
    const vtkSmartPointer<vtkPolyData> cones = conesOf(lines, radius);
    for (vtkPolyData* shape : {tubes->GetOutput(), cones.Get()}) {
        vtkNew<vtkPolyDataMapper> mapper;
        mapper->SetInputData(shape);
        mapper->SetScalarVisibility(scale != nullptr);
        if (scale) colourBy(mapper, *scale);
        vtkNew<vtkActor> actor;
        actor->SetMapper(mapper);
        actor->GetProperty()->SetColor(0.12, 0.12, 0.12);
        actor->GetProperty()->SetAmbient(0.55);
        actor->GetProperty()->SetDiffuse(0.5);
        renderer->AddActor(actor);
    }
}

double wallThickness(const particles::Box& box) { return 0.03 * box.size().maxCoeff(); }

void addBox(vtkRenderer* back, vtkRenderer* front, const particles::Box& box, const Camera& camera,
            double metresPerPixel, bool withPlates, const Cut* cut) {
    const Vec3 low = box.low * perMetre, high = box.high * perMetre;
    const auto isBehind = [&](int axis, bool upper) {  // whether the camera sees the inner side of this face
        Vec3 outwards = Vec3::Zero(), middle = box.middle();
        outwards[axis] = upper ? 1 : -1;
        middle[axis] = upper ? box.high[axis] + wallThickness(box) : box.low[axis] - wallThickness(box);
        return !camera.seesFromSide(middle, outwards);
    };
    for (int k = 0; k < 3; ++k) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        for (const bool upperA : {false, true}) {
            for (const bool upperB : {false, true}) {
                Vec3 from = low;
                from[a] = upperA ? high[a] : low[a];
                from[b] = upperB ? high[b] : low[b];
                Vec3 to = from;
                to[k] = high[k];
                vtkNew<vtkLineSource> line;
                line->SetPoint1(from.data());
                line->SetPoint2(to.data());
                vtkNew<vtkTubeFilter> tube;
                tube->SetInputConnection(line->GetOutputPort());
                tube->SetRadius(0.6 * metresPerPixel * perMetre);
                tube->SetNumberOfSides(6);
                tube->Update();
                const bool behind = isBehind(a, upperA) && isBehind(b, upperB);
                (behind ? back : front)->AddActor(flatActor(tube->GetOutput(), {0.45, 0.45, 0.48}));
            }
        }
        if (box.periodic[k] || !withPlates) continue;
        for (const bool upper : {false, true}) {
            Vec3 from = box.low, to = box.high;
            (upper ? from : to)[k] = upper ? box.high[k] : box.low[k];
            (upper ? to : from)[k] += upper ? wallThickness(box) : -wallThickness(box);
            if (cut) {
                double& end = (cut->removesUpper ? to : from)[cut->plane.axis];
                end = cut->removesUpper ? std::min(end, cut->plane.position) : std::max(end, cut->plane.position);
                if (from[cut->plane.axis] >= to[cut->plane.axis]) continue;
            }
            vtkNew<vtkCubeSource> plate;
            plate->SetBounds(from[0] * perMetre, to[0] * perMetre, from[1] * perMetre, to[1] * perMetre,
                             from[2] * perMetre, to[2] * perMetre);
            vtkNew<vtkPolyDataMapper> mapper;
            mapper->SetInputConnection(plate->GetOutputPort());
            vtkNew<vtkActor> actor;
            actor->SetMapper(mapper);
            vtkProperty* property = actor->GetProperty();
            property->SetColor(0.72, 0.75, 0.80);
            property->SetAmbient(0.55);
            property->SetDiffuse(0.5);
            if (!isBehind(k, upper)) property->SetOpacity(0.10);
            (isBehind(k, upper) ? back : front)->AddActor(actor);
        }
    }
}

void addWalls(vtkRenderer* back, vtkRenderer* front, const particles::Box& box, const boundary::Walls& walls,
              const Cut* cut, double rim) {
    if (!walls.exist()) return;
    // The surface of distance zero, of the distances at the nodes of a grid. Beyond the box there is no fluid, so that
    // walls that touch it are drawn whole.
    constexpr double samples = 120;
    const Vec3 size = box.size();
    const double spacing = size.maxCoeff() / samples;
    vtkNew<vtkImageData> grid;
    Vec3 origin = box.low;
    int count[3];
    for (int k = 0; k < 3; ++k) {
        const int margin = box.periodic[static_cast<std::size_t>(k)] ? 0 : 2;
        count[k] = static_cast<int>(std::lround(size[k] / spacing)) + 1 + 2 * margin;
        origin[k] -= margin * spacing;
    }
    grid->SetDimensions(count);
    grid->SetOrigin(origin[0] * perMetre, origin[1] * perMetre, origin[2] * perMetre);
    grid->SetSpacing(spacing * perMetre, spacing * perMetre, spacing * perMetre);
    grid->AllocateScalars(VTK_DOUBLE, 1);
    for (int k = 0; k < count[2]; ++k)
        for (int j = 0; j < count[1]; ++j)
            for (int i = 0; i < count[0]; ++i)
                *static_cast<double*>(grid->GetScalarPointer(i, j, k)) =
                    walls.distance(origin + spacing * Vec3(i, j, k)) * perMetre;
    vtkNew<vtkContourFilter> surface;
    surface->SetInputData(grid);
    surface->SetValue(0, 0);
    surface->ComputeNormalsOn();
    surface->Update();
    vtkSmartPointer<vtkPolyData> shown = surface->GetOutput();
    if (cut) {
        addTubes(front, rimOf(shown, cut->plane), rim, {0.45, 0.48, 0.53});
        shown = remainder(shown, *cut);
    }
    for (const bool behind : {true, false}) {
        vtkNew<vtkPolyDataMapper> mapper;
        mapper->SetInputData(shown);
        mapper->ScalarVisibilityOff();
        vtkNew<vtkActor> actor;
        actor->SetMapper(mapper);
        vtkProperty* property = actor->GetProperty();
        property->SetColor(0.72, 0.75, 0.80);
        property->SetAmbient(0.45);
        property->SetDiffuse(0.6);
        property->SetFrontfaceCulling(behind);
        property->SetBackfaceCulling(!behind);
        if (!behind) property->SetOpacity(0.10);
        (behind ? back : front)->AddActor(actor);
    }
}

}  // namespace corpuscle
