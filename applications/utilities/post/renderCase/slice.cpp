#include "slice.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "interpolation.hpp"

namespace corpuscle {
namespace {

constexpr int mostPoints = 700;  // number of grid points along an axis

}  // namespace

Vec3 Slice::place(int column, int row) const {
    Vec3 x;
    x[plane.axis] = plane.position;
    x[plane.first()] = x0 + column * dx;
    x[plane.second()] = y0 + row * dy;
    return x;
}

Slice sampleSlice(const io::PolyData& fluid, const std::optional<particles::Box>& box, const Plane& plane,
                  const std::string& field, bool withVelocity) {
    Slice slice;
    slice.plane = plane;
    if (fluid.points.empty()) return slice;
    const particles::Box extent = extentOf(fluid, box);
    Vec3 low = extent.low, high = extent.high;
    low[plane.axis] = high[plane.axis] = plane.position;
    const Interpolation interpolation(fluid, extent, field, low, high);
    if (withVelocity && !interpolation.hasVelocity())
        throw Failure(ExitCode::usage, "-arrows: the fluid has no array 'velocity'; add it to write.fields.");
    const auto intervals = [&](int axis) {
        return std::clamp(static_cast<int>(std::ceil(2 * extent.size()[axis] / interpolation.spacing())), 1,
                          mostPoints - 1);
    };
    slice.columns = intervals(plane.first()) + 1;
    slice.rows = intervals(plane.second()) + 1;
    slice.x0 = extent.low[plane.first()];
    slice.y0 = extent.low[plane.second()];
    slice.dx = extent.size()[plane.first()] / (slice.columns - 1);
    slice.dy = extent.size()[plane.second()] / (slice.rows - 1);
    for (int row = 0; row < slice.rows; ++row) {
        for (int column = 0; column < slice.columns; ++column) {
            const Interpolation::Values values = interpolation.at(slice.place(column, row));
            slice.values.push_back(values.field);
            if (withVelocity) slice.velocity.push_back(values.velocity);
        }
    }
    return slice;
}

}  // namespace corpuscle
