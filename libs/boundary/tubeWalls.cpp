#include "boundary/tubeWalls.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace corpuscle::boundary {

namespace {
constexpr double pi = std::numbers::pi;
constexpr double slowestMode = 2.4048;  // first zero of J0
}  // namespace

RoundTube::RoundTube(double radius, const particles::Box& fluid)
    : radius_(radius), length_(fluid.size()[0]), middle_(fluid.middle()) {}

double RoundTube::distance(const Vec3& x) const { return radius_ - std::hypot(x[1] - middle_[1], x[2] - middle_[2]); }

Vec3 RoundTube::normal(const Vec3& x) const {
    const Vec3 r(0, x[1] - middle_[1], x[2] - middle_[2]);
    return r.isZero() ? Vec3(0, 0, 1) : Vec3(-r.normalized());  // on the axis any direction is valid
}

double RoundTube::area() const { return 2 * pi * radius_ * length_; }

void RoundTube::takeLeast(const Points& points, double* least) const {
    const double *const y = points.coordinate[1], *const z = points.coordinate[2];
    for (std::size_t i = 0; i < points.count; ++i) {
        const double across = y[i] - middle_[1], up = z[i] - middle_[2];
        least[i] = std::min(least[i], radius_ - std::sqrt(across * across + up * up));
    }
}

const Schema<TubeWalls>& TubeWalls::schema() {
    static const Schema<TubeWalls> s =
        Schema<TubeWalls>("tube", "a round tube along x, in the middle of the box")
            .quantity("diameter", &TubeWalls::diameter, unit::metre, "of the tube", {.range = positive});
    return s;
}

void TubeWalls::check(const particles::Box& fluid, const Mark& mark, Problems& problems) const {
    for (const int axis : {1, 2}) checkWidth("diameter", diameter, axis, fluid, mark, problems);
}

Walls TubeWalls::place(const particles::Box& fluid) const {
    Walls walls;
    walls.add("tube", std::make_shared<RoundTube>(radius(), fluid));
    return walls;
}

double TubeWalls::volume(const particles::Box& fluid) const { return pi * radius() * radius() * fluid.size()[0]; }

double TubeWalls::volumeBehind(const particles::Box& fluid, const Vec3& depth) const {
    const double outer = radius() + depth.maxCoeff();
    return pi * (outer * outer - radius() * radius()) * fluid.size()[0];
}

Hydraulics TubeWalls::hydraulics(const particles::Box& /*fluid*/) const {
    const double R2 = radius() * radius();
    return {radius(), R2 / 4, R2 / (slowestMode * slowestMode), pi * R2 * R2 / 8};
}

CORPUSCLE_REGISTER(WallShape, TubeWalls, "tube", "a round tube along x");

}  // namespace corpuscle::boundary
