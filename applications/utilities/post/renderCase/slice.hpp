// The fluid in a plane, at the points of a grid.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/polyData.hpp"
#include "particles/box.hpp"
#include "plane.hpp"

namespace corpuscle {

struct Slice {
    Plane plane;
    int columns = 0, rows = 0;  // number of points along the first and second axis of the plane
    double x0 = 0, y0 = 0, dx = 0, dy = 0;
    std::vector<double> values;  // row by row; NaN: no fluid there
    std::vector<Vec3> velocity;  // empty unless asked for; NaN: no fluid there

    Vec3 place(int column, int row) const;
    std::size_t index(int column, int row) const { return static_cast<std::size_t>(row) * columns + column; }
};

// `field`: u, v, w or speed, from the velocity of the particles, or the name of one of their arrays. Without a box the
// slice covers the extent of the fluid. Throws Failure(usage) for an unknown field; the message names the existing
// ones.
Slice sampleSlice(const io::PolyData& fluid, const std::optional<particles::Box>& box, const Plane& plane,
                  const std::string& field, bool withVelocity);

}  // namespace corpuscle
