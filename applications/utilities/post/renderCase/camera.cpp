#include "camera.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle {
namespace {

// `right` and `up` of a camera that looks from this azimuth (from -y towards +x) and elevation [degrees].
View fromAngles(const std::string& name, double azimuth, double elevation, bool perspective) {
    const double a = azimuth * M_PI / 180, e = elevation * M_PI / 180;
    const Vec3 ahead(-std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), -std::sin(e));
    const Vec3 right = ahead.cross(Vec3::UnitZ()).normalized();
    return {name, right, right.cross(ahead), perspective, 1};
}

// Half of the angle at which the camera sees the sphere around all points.
constexpr double halfAngle = 13 * M_PI / 180;

}  // namespace

void ValueRange::add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
}

const std::vector<View>& views() {
    // Seen from slightly upstream, a red cell that turns in shear shows a dimple in each quarter of a turn.
    static const std::vector<View> all{
        fromAngles("tilted", -14, 36, true),
        {"xz", Vec3::UnitX(), Vec3::UnitZ(), false, 1},
        {"xy", Vec3::UnitX(), Vec3::UnitY(), false, 2},
        {"yz", Vec3::UnitY(), Vec3::UnitZ(), false, 0},
        {"iso", Vec3(2, 1, 0).normalized(), Vec3(-1, 2, 4).normalized(), false, 1},
    };
    return all;
}

View turnedForWalls(View view, const std::array<bool, 3>& periodic) {
    const bool wallsAcrossY = !periodic[1] && periodic[2];
    if (view.name != "tilted" || !wallsAcrossY) return view;
    const auto turned = [](const Vec3& x) { return Vec3(x[0], x[2], -x[1]); };
    return {view.name, turned(view.right), turned(view.up), view.perspective, 2};
}

Camera::Camera(const View& view, const std::vector<Vec3>& shown) : view_(view) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::max()), high = -low;
    for (const Vec3& x : shown) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    focus_ = 0.5 * (low + high);
    const double radius = std::max(0.5 * (high - low).norm(), 1e-12);
    distance_ = radius / std::sin(halfAngle);
    for (const Vec3& x : shown) {
        const auto [u, v] = project(x);
        u_.add(u);
        v_.add(v);
    }
}

bool Camera::seesFromSide(const Vec3& place, const Vec3& normal) const {
    const Vec3 towardsEye = view_.perspective ? Vec3(eye() - place) : Vec3(-distance_ * view_.ahead());
    return towardsEye.dot(normal) > 1e-6 * distance_;
}

std::array<double, 2> Camera::project(const Vec3& x) const {
    const Vec3 d = x - focus_;
    const double depth = distance_ + d.dot(view_.ahead());
    const double factor = view_.perspective ? distance_ / depth : 1;
    return {factor * d.dot(view_.right), factor * d.dot(view_.up)};
}

}  // namespace corpuscle
