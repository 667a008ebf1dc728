#include "boundary/planeWalls.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace corpuscle::boundary {

Plane::Plane(int axis, double position, double side, double area)
    : axis_(axis), position_(position), side_(side), area_(area) {}

Vec3 Plane::normal(const Vec3& /*x*/) const { return side_ * Vec3::Unit(axis_); }

void Plane::takeLeast(const Points& points, double* least) const {
    const double* const x = points.coordinate[axis_];
    for (std::size_t i = 0; i < points.count; ++i) least[i] = std::min(least[i], side_ * (x[i] - position_));
}

const Schema<PlaneWalls>& PlaneWalls::schema() {
    static const Schema<PlaneWalls> s =
        Schema<PlaneWalls>("planes", "two parallel walls at the ends of the box")
            .word("normal", &PlaneWalls::axis, {"x", "y", "z"}, "axis that the walls are normal to", {.fallback = "z"});
    return s;
}

Walls PlaneWalls::place(const particles::Box& fluid) const {
    const int k = normal();
    const double area = fluid.volume() / fluid.size()[k];
    Walls walls;
    walls.add("lower", std::make_shared<Plane>(k, fluid.low[k], 1, area));
    walls.add("upper", std::make_shared<Plane>(k, fluid.high[k], -1, area));
    return walls;
}

double PlaneWalls::volumeBehind(const particles::Box& fluid, const Vec3& depth) const {
    return 2 * depth[normal()] * fluid.volume() / fluid.size()[normal()];
}

// u = f/(2 nu) y (h - y), which settles by exp(-pi^2 nu t/h^2).
Hydraulics PlaneWalls::hydraulics(const particles::Box& fluid) const {
    const double h = fluid.size()[normal()];
    Hydraulics found{h, h * h / 8, std::pow(h / std::numbers::pi, 2), {}};
    if (normal() != 0) found.conductance = std::pow(h, 3) / 12 * fluid.size()[3 - normal()];
    return found;
}

CORPUSCLE_REGISTER(WallShape, PlaneWalls, "planes", "two parallel walls at the ends of the box");

}  // namespace corpuscle::boundary
