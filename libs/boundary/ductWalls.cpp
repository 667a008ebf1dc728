#include "boundary/ductWalls.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace corpuscle::boundary {

namespace {
constexpr double pi = std::numbers::pi;
}  // namespace

RectangularDuct::RectangularDuct(double width, double height, const particles::Box& fluid)
    : halfWidth_(0.5 * width), halfHeight_(0.5 * height), length_(fluid.size()[0]), middle_(fluid.middle()) {}

double RectangularDuct::fromAxis(double y, double z) const {
    const double across = std::abs(y - middle_[1]) - halfWidth_, up = std::abs(z - middle_[2]) - halfHeight_;
    if (across > 0 && up > 0) return -std::sqrt(across * across + up * up);
    return -std::max(across, up);
}

double RectangularDuct::distance(const Vec3& x) const { return fromAxis(x[1], x[2]); }

Vec3 RectangularDuct::normal(const Vec3& x) const {
    const double y = x[1] - middle_[1], z = x[2] - middle_[2];
    const double across = std::abs(y) - halfWidth_, up = std::abs(z) - halfHeight_;
    const Vec3 ny(0, y > 0 ? -1 : 1, 0), nz(0, 0, z > 0 ? -1 : 1);
    if (across > 0 && up > 0) return (across * ny + up * nz).normalized();
    return across > up ? ny : nz;
}

double RectangularDuct::area() const { return 4 * (halfWidth_ + halfHeight_) * length_; }

void RectangularDuct::takeLeast(const Points& points, double* least) const {
    for (std::size_t i = 0; i < points.count; ++i)
        least[i] = std::min(least[i], fromAxis(points.coordinate[1][i], points.coordinate[2][i]));
}

const Schema<DuctWalls>& DuctWalls::schema() {
    static const Schema<DuctWalls> s =
        Schema<DuctWalls>("duct", "a duct of rectangular cross-section along x, in the middle of the box")
            .quantity("width", &DuctWalls::width, unit::metre, "along y", {.range = positive})
            .quantity("height", &DuctWalls::height, unit::metre, "along z", {.range = positive});
    return s;
}

void DuctWalls::check(const particles::Box& fluid, const Mark& mark, Problems& problems) const {
    checkWidth("width", width, 1, fluid, mark, problems);
    checkWidth("height", height, 2, fluid, mark, problems);
}

Walls DuctWalls::place(const particles::Box& fluid) const {
    Walls walls;
    walls.add("duct", std::make_shared<RectangularDuct>(width, height, fluid));
    return walls;
}

// Rounded at the edges, as is the distance there.
double DuctWalls::volumeBehind(const particles::Box& fluid, const Vec3& depth) const {
    const double d = depth.maxCoeff();
    return (2 * d * (width + height) + pi * d * d) * fluid.size()[0];
}

Hydraulics DuctWalls::hydraulics(const particles::Box& /*fluid*/) const {
    const double w = std::min(width, height), h = std::max(width, height);
    double rate = 0, fastest = 0;
    for (int i = 1, sign = 1; i < 200; i += 2, sign = -sign) {
        const double a = i * pi * h / (2 * w);
        rate += std::tanh(a) / std::pow(i, 5);
        fastest += sign / std::pow(i, 3) * (1 - 1 / std::cosh(std::min(a, 700.0)));
    }
    return {w, 4 * w * w / std::pow(pi, 3) * fastest, 1 / (pi * pi * (1 / (w * w) + 1 / (h * h))),
            std::pow(w, 3) * h / 12 * (1 - 192 * w / (std::pow(pi, 5) * h) * rate)};
}

CORPUSCLE_REGISTER(WallShape, DuctWalls, "duct", "a duct of rectangular cross-section along x");

}  // namespace corpuscle::boundary
