#include "boundary/revolvedTube.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace corpuscle::boundary {

namespace {
constexpr double pi = std::numbers::pi;
constexpr double slowestMode = 2.4048;  // first zero of the Bessel function J0
constexpr double mostEntries = 16384;   // of the table
}  // namespace

RevolvedTube::RevolvedTube(std::shared_ptr<const RadiusProfile> profile, const particles::Box& fluid)
    : profile_(std::move(profile)), middle_(fluid.middle()), length_(fluid.size()[0]) {
    constexpr int samples = 4096;
    const double h = length_ / samples;
    least_ = profile_->at(0).radius;
    for (int k = 0; k < samples; ++k) {
        const auto [R, slope, curvature] = profile_->at((k + 0.5) * h - 0.5 * length_);
        least_ = std::min(least_, R), largest_ = std::max(largest_, R);
        area_ += 2 * pi * R * std::sqrt(1 + slope * slope) * h;
        volume_ += pi * R * R * h;
        turn_ += pi * (1 - R * curvature / (1 + slope * slope)) * h;
        resistance_ += h / std::pow(R, 4);
    }
    const auto count = static_cast<std::size_t>(std::min(std::ceil(64 * length_ / least_), mostEntries));
    step_ = length_ / static_cast<double>(count);
    for (std::size_t k = 0; k < count; ++k) table_.push_back(profile_->at(static_cast<double>(k) * step_).radius);
}

RevolvedTube::Foot RevolvedTube::foot(double x, double r) const {
    const double within = std::abs(profile_->at(x).radius - r);
    const auto count = static_cast<long>(table_.size());
    double s = x, best = within * within;
    for (long k = std::lround((x - within) / step_); k <= std::lround((x + within) / step_); ++k) {
        const double along = static_cast<double>(k) * step_ - x,
                     up = table_[static_cast<std::size_t>(((k % count) + count) % count)] - r;
        if (const double distance2 = along * along + up * up; distance2 < best)
            best = distance2, s = static_cast<double>(k) * step_;
    }
    const double low = s - step_, high = s + step_;
    RadiusProfile::Value at = profile_->at(s);
    for (int k = 0; k < 20; ++k) {
        const double slope = (s - x) + (at.radius - r) * at.slope;
        const double stiffness = std::max(1 + at.slope * at.slope + (at.radius - r) * at.curvature, 0.1);
        const double next = std::clamp(s - slope / stiffness, low, high);
        if (std::abs(next - s) < 1e-12 * step_) break;
        s = next, at = profile_->at(s);
    }
    return {s, at.radius, at.slope};
}

double RevolvedTube::distance(const Vec3& p) const {
    const double x = p[0] - middle_[0], r = std::hypot(p[1] - middle_[1], p[2] - middle_[2]);
    const Foot at = foot(x, r);
    return std::copysign(std::hypot(at.x - x, at.radius - r), profile_->at(x).radius - r);
}

Vec3 RevolvedTube::normal(const Vec3& p) const {
    const Vec3 across(0, p[1] - middle_[1], p[2] - middle_[2]);
    const double r = across.norm();
    const Foot at = foot(p[0] - middle_[0], r);
    const Vec3 out = r > 0 ? Vec3(across / r) : Vec3(0, 0, 1);  // on the axis any direction is valid
    return (at.slope * Vec3(1, 0, 0) - out).normalized();
}

Walls RevolvedWalls::place(const particles::Box& fluid) const {
    Walls walls;
    walls.add("tube", std::make_shared<RevolvedTube>(profile(fluid.size()[0]), fluid));
    return walls;
}

double RevolvedWalls::volume(const particles::Box& fluid) const { return tube(fluid).volume(); }

// Steiner's formula for the surface at a distance; that of a tube which closes on itself has no cubic term.
double RevolvedWalls::volumeBehind(const particles::Box& fluid, const Vec3& depth) const {
    const double d = depth.maxCoeff();
    const RevolvedTube all = tube(fluid);
    return all.area() * d + all.meanCurvature() * d * d;
}

Hydraulics RevolvedWalls::hydraulics(const particles::Box& fluid) const {
    const RevolvedTube all = tube(fluid);
    const double least = all.leastRadius(), length = fluid.size()[0];
    const double rate = pi * length / (8 * all.slenderResistance());  // flow rate nu/f
    const double widest = all.largestRadius();
    return {least, 2 * rate / (pi * least * least), std::pow(widest / slowestMode, 2), {}};
}

}  // namespace corpuscle::boundary
