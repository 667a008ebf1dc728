#include "boundary/ellipticTubeWalls.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace corpuscle::boundary {

namespace {

constexpr double pi = std::numbers::pi;

// Perimeter of an ellipse by its arithmetic-geometric mean.
double perimeter(double a, double b) {
    double mean = a, other = b, power = 0.5, sum = 0.5 * (a * a - b * b);
    while (std::abs(mean - other) > 1e-15 * mean) {
        const double next = 0.5 * (mean + other), c = 0.5 * (mean - other);
        other = std::sqrt(mean * other);
        mean = next;
        power *= 2;
        sum += power * c * c;
    }
    return 2 * pi / mean * (a * a - sum);
}

}  // namespace

EllipticTube::EllipticTube(double width, double height, const particles::Box& fluid)
    : halfWidth_(0.5 * width), halfHeight_(0.5 * height), length_(fluid.size()[0]), middle_(fluid.middle()) {}

Vec3 EllipticTube::nearest(const Vec3& r) const {
    const bool wide = halfWidth_ >= halfHeight_;
    const double a = wide ? halfWidth_ : halfHeight_, b = wide ? halfHeight_ : halfWidth_;
    const double p = std::abs(wide ? r[1] : r[2]), q = std::abs(wide ? r[2] : r[1]);
    double x = a, y = 0;  // on the long axis, beyond the centre of its curvature
    if (q > 1e-12 * b) {
        double t = b * q - b * b;
        for (int k = 0; k < 100; ++k) {
            const double u = a * p / (t + a * a), v = b * q / (t + b * b), f = u * u + v * v - 1;
            const double slope = -2 * (u * u / (t + a * a) + v * v / (t + b * b)), next = t - f / slope;
            if (!(next > t * (1 + (t > 0 ? 1e-15 : -1e-15)))) break;
            t = next;
        }
        x = a * a * p / (t + a * a), y = b * b * q / (t + b * b);
    } else if (const double c = a * a - b * b; a * p < c) {
        x = a * a * p / c;
        y = b * std::sqrt(std::max(0.0, 1 - x * x / (a * a)));
    }
    const double along = std::copysign(wide ? x : y, r[1]), up = std::copysign(wide ? y : x, r[2]);
    return {0, along, up};
}

bool EllipticTube::isInside(const Vec3& r) const {
    return std::pow(r[1] / halfWidth_, 2) + std::pow(r[2] / halfHeight_, 2) < 1;
}

double EllipticTube::distance(const Vec3& x) const {
    const Vec3 r(0, x[1] - middle_[1], x[2] - middle_[2]);
    const double away = (r - nearest(r)).norm();
    return isInside(r) ? away : -away;
}

Vec3 EllipticTube::normal(const Vec3& x) const {
    const Vec3 at = nearest(Vec3(0, x[1] - middle_[1], x[2] - middle_[2]));
    return Vec3(0, -at[1] / (halfWidth_ * halfWidth_), -at[2] / (halfHeight_ * halfHeight_)).normalized();
}

double EllipticTube::area() const {
    return perimeter(std::max(halfWidth_, halfHeight_), std::min(halfWidth_, halfHeight_)) * length_;
}

const Schema<EllipticTubeWalls>& EllipticTubeWalls::schema() {
    static const Schema<EllipticTubeWalls> s =
        Schema<EllipticTubeWalls>("ellipticTube", "a tube of elliptic cross-section along x, in the middle of the box")
            .quantity("width", &EllipticTubeWalls::width, unit::metre, "axis of the ellipse along y",
                      {.range = positive})
            .quantity("height", &EllipticTubeWalls::height, unit::metre, "axis of the ellipse along z",
                      {.range = positive});
    return s;
}

void EllipticTubeWalls::check(const particles::Box& fluid, const Mark& mark, Problems& problems) const {
    checkWidth("width", width, 1, fluid, mark, problems);
    checkWidth("height", height, 2, fluid, mark, problems);
}

Walls EllipticTubeWalls::place(const particles::Box& fluid) const {
    Walls walls;
    walls.add("tube", std::make_shared<EllipticTube>(width, height, fluid));
    return walls;
}

double EllipticTubeWalls::volume(const particles::Box& fluid) const {
    return 0.25 * pi * width * height * fluid.size()[0];
}

// A parallel curve at distance d of a convex curve encloses (perimeter d + pi d^2) more.
double EllipticTubeWalls::volumeBehind(const particles::Box& fluid, const Vec3& depth) const {
    const double d = depth.maxCoeff();
    return EllipticTube(width, height, fluid).area() * d + pi * d * d * fluid.size()[0];
}

// The flow settles faster than between planes at the distance of the shorter axis.
Hydraulics EllipticTubeWalls::hydraulics(const particles::Box& /*fluid*/) const {
    const double a2 = 0.25 * width * width, b2 = 0.25 * height * height, least = std::min(width, height);
    return {0.5 * least, a2 * b2 / (2 * (a2 + b2)), std::pow(least / pi, 2),
            pi * std::pow(a2 * b2, 1.5) / (4 * (a2 + b2))};
}

CORPUSCLE_REGISTER(WallShape, EllipticTubeWalls, "ellipticTube", "a tube of elliptic cross-section along x");

}  // namespace corpuscle::boundary
