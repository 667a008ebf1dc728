#include "cut.hpp"

#include <fmt/format.h>
#include <vtkClipPolyData.h>
#include <vtkCutter.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkNew.h>
#include <vtkPlane.h>

#include <algorithm>
#include <array>

#include "actors.hpp"
#include "core/error.hpp"

namespace corpuscle {
namespace {

vtkSmartPointer<vtkPlane> functionOf(const Plane& plane, double sign) {
    auto function = vtkSmartPointer<vtkPlane>::New();
    const Vec3 normal = sign * plane.normal(), origin = plane.position * perMetre * plane.normal();
    function->SetNormal(normal.data());
    function->SetOrigin(origin.data());
    return function;
}

}  // namespace

Cut cutFor(const Plane& plane, const Camera& camera) {
    Vec3 place = camera.focus();
    place[plane.axis] = plane.position;
    const bool above = camera.seesFromSide(place, plane.normal()), below = camera.seesFromSide(place, -plane.normal());
    if (above == below)
        throw Failure(ExitCode::usage,
                      fmt::format("-cut {}: the view {} sees this plane edge-on; choose another axis or another -view.",
                                  plane.axisName(), camera.view().name));
    return {plane, above};
}

vtkSmartPointer<vtkPolyData> remainder(vtkPolyData* surface, const Cut& cut) {
    vtkNew<vtkClipPolyData> clip;
    clip->SetInputData(surface);
    clip->SetClipFunction(functionOf(cut.plane, cut.removesUpper ? -1 : 1));
    clip->Update();
    return clip->GetOutput();
}

vtkSmartPointer<vtkPolyData> rimOf(vtkPolyData* surface, const Plane& plane) {
    vtkNew<vtkCutter> cutter;
    cutter->SetInputData(surface);
    cutter->SetCutFunction(functionOf(plane, 1));
    cutter->Update();
    return cutter->GetOutput();
}

std::vector<double> distancesFrom(const std::map<std::string, io::PolyData>& surfaces, const Slice& slice) {
    // Beyond the bounds of a surface only the sign matters, and by how much the points beside it differ.
    const double far = slice.dx + slice.dy;
    std::vector<double> distances(slice.values.size(), far);
    for (const auto& [name, surface] : surfaces) {
        const vtkSmartPointer<vtkPolyData> poly = trianglesOf(surface);
        std::array<double, 6> bounds{};
        poly->GetBounds(bounds.data());
        vtkNew<vtkImplicitPolyDataDistance> distance;
        distance->SetInput(poly);
        for (int row = 0; row < slice.rows; ++row) {
            for (int column = 0; column < slice.columns; ++column) {
                Vec3 x = slice.place(column, row) * perMetre;
                bool near = true;
                for (int k = 0; k < 3; ++k)
                    near = near && x[k] > bounds[2 * k] - far * perMetre && x[k] < bounds[2 * k + 1] + far * perMetre;
                if (!near) continue;
                double& least = distances[slice.index(column, row)];
                least = std::min(least, distance->EvaluateFunction(x.data()) / perMetre);
            }
        }
    }
    return distances;
}

}  // namespace corpuscle
