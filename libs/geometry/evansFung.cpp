#include "geometry/evansFung.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace corpuscle::geometry {

CORPUSCLE_REGISTER(Shape, EvansFung, "evansFung", "measured profile of the human red cell, Evans and Fung 1972");

const Schema<EvansFung>& EvansFung::schema() {
    static const Schema<EvansFung> s =
        Schema<EvansFung>("evansFung", "mean profile of the human red cell")
            .quantity("R0", &EvansFung::R0, unit::metre, "radius of the disc",
                      {.fallback = "3.91 um", .range = positive})
            .quantity("C0", &EvansFung::C0, unit::metre, "thickness on the axis",
                      {.fallback = "0.81 um", .range = positive})
            .quantity("C2", &EvansFung::C2, unit::metre, "coefficient of (r/R0)^2", {.fallback = "7.83 um"})
            .quantity("C4", &EvansFung::C4, unit::metre, "coefficient of (r/R0)^4", {.fallback = "-4.39 um"});
    return s;
}

void EvansFung::prepare(const std::filesystem::path&) const {
    if (!(R0 > 0)) throw Failure(ExitCode::invalidCase, "evansFung: R0 must be greater than 0");
    double lowest = std::min(p(0), p(1)), where = p(0) < p(1) ? 0 : 1;
    if (C4 > 0)
        if (const double s = -C2 / (2 * C4); s > 0 && s < 1 && p(s) < lowest) lowest = p(s), where = s;
    if (!(lowest > 0))
        throw Failure(
            ExitCode::invalidCase,
            fmt::format("evansFung: the thickness C0 + C2 s + C4 s^2 falls to {:.4g} um at r = {:.4g} um; it must stay "
                        "above 0 from the axis to R0: take a greater C0 or C2",
                        lowest * 1e6, R0 * std::sqrt(where) * 1e6));
}

double EvansFung::implicit(const Vec3& x) const {
    const double s = (x.x() * x.x() + x.y() * x.y()) / (R0 * R0), t = p(s);
    return x.z() * x.z() - (1 - s) * t * t / 4;
}

Vec3 EvansFung::gradient(const Vec3& x) const {
    const double s = (x.x() * x.x() + x.y() * x.y()) / (R0 * R0), t = p(s);
    const double dFds = t * t / 4 - (1 - s) * t * dp(s) / 2;
    return {dFds * 2 * x.x() / (R0 * R0), dFds * 2 * x.y() / (R0 * R0), 2 * x.z()};
}

Eigen::AlignedBox3d EvansFung::box() const {
    double highest = 0;
    for (int i = 0; i <= 1000; ++i) highest = std::max(highest, profile(i * std::numbers::pi / 2000).z);
    const Vec3 half(R0, R0, highest * 1.00001);
    return {-half, half};
}

AxisymmetricShape::ProfilePoint EvansFung::profile(double t) const {
    const double sine = std::sin(t), cosine = std::cos(t), s = sine * sine;
    return {R0 * sine, cosine * p(s) / 2, R0 * cosine, -sine * p(s) / 2 + cosine * dp(s) * sine * cosine};
}

}  // namespace corpuscle::geometry
