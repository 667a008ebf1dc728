#include "boundary/modelNameWalls.hpp"

#include <cmath>
#include <numbers>

namespace corpuscle::boundary {

ModelNameSurface::ModelNameSurface(double radius, const particles::Box& fluid)
    : radius_(radius), length_(fluid.size()[0]), middle_(fluid.middle()) {}

Vec3 ModelNameSurface::fromAxis(const Vec3& x) const { return {0, x[1] - middle_[1], x[2] - middle_[2]}; }

double ModelNameSurface::distance(const Vec3& x) const { return radius_ - fromAxis(x).norm(); }

Vec3 ModelNameSurface::normal(const Vec3& x) const {
    const Vec3 r = fromAxis(x);
    return r.isZero() ? Vec3(0, 0, 1) : Vec3(-r.normalized());  // on the axis any direction is valid
}

double ModelNameSurface::area() const { return 2 * std::numbers::pi * radius_ * length_; }

const Schema<ModelNameWalls>& ModelNameWalls::schema() {
    static const Schema<ModelNameWalls> s =
        Schema<ModelNameWalls>("modelName", "a round tube along x")
            .quantity("radius", &ModelNameWalls::radius, unit::metre, "of the tube", {.range = positive});
    return s;
}

Walls ModelNameWalls::place(const particles::Box& fluid) const {
    Walls walls;
    walls.add("tube", std::make_shared<ModelNameSurface>(radius, fluid));
    return walls;
}

double ModelNameWalls::volume(const particles::Box& fluid) const {
    return std::numbers::pi * radius * radius * fluid.size()[0];
}

double ModelNameWalls::volumeBehind(const particles::Box& fluid, const Vec3& depth) const {
    const double outer = radius + std::max(depth[1], depth[2]);
    return std::numbers::pi * (outer * outer - radius * radius) * fluid.size()[0];
}

// Poiseuille's flow: u = f/(4 nu) (R^2 - r^2). It settles by exp(-5.78 nu t/R^2).
Hydraulics ModelNameWalls::hydraulics(const particles::Box& /*fluid*/) const {
    const double R2 = radius * radius;
    return {radius, R2 / 4, R2 / 5.78, std::numbers::pi * R2 * R2 / 8};
}

CORPUSCLE_REGISTER(WallShape, ModelNameWalls, "modelName", "a round tube along x");

}  // namespace corpuscle::boundary
