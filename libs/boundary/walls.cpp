#include "boundary/walls.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace corpuscle::boundary {

namespace {
constexpr double far = std::numeric_limits<double>::infinity();
}  // namespace

void Surface::takeLeast(const Points& points, double* least) const {
    for (std::size_t i = 0; i < points.count; ++i) least[i] = std::min(least[i], distance(points[i]));
}

void Walls::add(std::string name, std::shared_ptr<const Surface> surface) {
    walls_.push_back({static_cast<int>(walls_.size()), std::move(name), std::move(surface)});
}

const Wall& Walls::nearest(const Vec3& x) const {
    return *std::min_element(walls_.begin(), walls_.end(),
                             [&](const Wall& one, const Wall& other) { return one.distance(x) < other.distance(x); });
}

double Walls::distance(const Vec3& x) const {
    double least = far;
    for (const Wall& wall : walls_) least = std::min(least, wall.distance(x));
    return least;
}

void Walls::findDistances(const Points& points, std::vector<double>& distance) const {
    distance.assign(points.count, far);
    for (const Wall& wall : walls_) wall.surface->takeLeast(points, distance.data());
}

}  // namespace corpuscle::boundary
