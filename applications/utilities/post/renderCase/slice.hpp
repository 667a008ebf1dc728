// The fluid in a plane, interpolated from its particles.
//
// At each point x of a grid in the plane, field and gradient follow from a linear least-squares fit to the particles
// around x:
//     minimise over (f, g)   sum_i W(|x - x_i|/h) (f + g.(x_i - x) - f_i)^2,   h = 2.2 dx, W Wendland C2,
// which is exact for linear fields, also at walls. Where the particles do not determine a gradient, Shepard's mean is
// used. A point farther than 1.3 dx from all particles is left blank. Arrays of integers take the value of the nearest
// particle.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "camera.hpp"
#include "io/polyData.hpp"
#include "particles/box.hpp"

namespace corpuscle {

struct SlicePlane {
    int axis = 1;         // of the plane's normal
    double position = 0;  // m
    int first() const { return axis == 0 ? 1 : 0; }
    int second() const { return axis == 2 ? 1 : 2; }
};

struct Slice {
    SlicePlane plane;
    int columns = 0, rows = 0;  // number of points along the first and second axis of the plane
    double x0 = 0, y0 = 0, dx = 0, dy = 0;
    std::vector<double> values;  // row by row; NaN: no fluid there
    std::vector<Vec3> velocity;  // empty unless asked for; NaN: no fluid there

    Vec3 place(int column, int row) const;
    std::size_t index(int column, int row) const { return static_cast<std::size_t>(row) * columns + column; }
};

// Periodic images of the box, sliding as recorded in the field data of the results.
Periodicity periodicityOf(const io::PolyData& data, const particles::Box& box);

// `field`: u, v, w or speed, from the velocity of the particles, or the name of one of their arrays. Without a box the
// slice covers the extent of the fluid. Throws Failure(usage) for an unknown field; the message names the existing
// ones.
Slice sampleSlice(const io::PolyData& fluid, const std::optional<particles::Box>& box, const SlicePlane& plane,
                  const std::string& field, bool withVelocity);

}  // namespace corpuscle
