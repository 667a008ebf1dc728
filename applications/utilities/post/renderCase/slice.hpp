// The fluid in a plane, interpolated from its particles.
//
// At each point x of a grid in the plane the field and its gradient are those of the plane's least-squares fit to the
// particles around:
//     minimise over (f, g)   sum_i W(|x - x_i|/h) (f + g.(x_i - x) - f_i)^2,   h = 2.2 dx, W Wendland C2,
// exact for linear fields, at walls too. Where the particles do not determine a gradient it is Shepard's mean. A point
// further than 1.3 dx from all particles is left blank. Arrays of integers take the value of the nearest particle.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "camera.hpp"
#include "io/polyData.hpp"
#include "particles/box.hpp"

namespace corpuscle {

struct SlicePlane {
    int axis = 1;         // of its normal
    double position = 0;  // m
    int first() const { return axis == 0 ? 1 : 0; }
    int second() const { return axis == 2 ? 1 : 2; }
};

struct Slice {
    SlicePlane plane;
    int columns = 0, rows = 0;  // points along the first and second axis of the plane
    double x0 = 0, y0 = 0, dx = 0, dy = 0;
    std::vector<double> values;  // row by row; NaN: no fluid
    std::vector<Vec3> velocity;  // empty unless asked for; NaN: no fluid

    Vec3 place(int column, int row) const;
    std::size_t index(int column, int row) const { return static_cast<std::size_t>(row) * columns + column; }
};

// Images of the box, which slide as the field data of results say.
Periodicity periodicityOf(const io::PolyData& data, const particles::Box& box);

// `field`: u, v, w or speed of the particles' velocity, or an array of theirs. Without a box the slice is as large as
// the fluid. Throws Failure(usage) for a field that there is not, naming those that there are.
Slice sampleSlice(const io::PolyData& fluid, const std::optional<particles::Box>& box, const SlicePlane& plane,
                  const std::string& field, bool withVelocity);

}  // namespace corpuscle
