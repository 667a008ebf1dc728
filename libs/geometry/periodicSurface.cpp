#include "geometry/periodicSurface.hpp"

#include <cmath>
#include <limits>

namespace corpuscle::geometry {

NearestImages::NearestImages(const TriangleTree& grid, const std::vector<Vec3>& nodes, const Periodicity& period)
    : grid_(grid), period_(period), low_(nodes.front()), high_(nodes.front()) {
    for (const Vec3& x : nodes) low_ = low_.cwiseMin(x), high_ = high_.cwiseMax(x);
    low_.array() -= grid.reach();
    high_.array() += grid.reach();
}

NearestImages::Found NearestImages::nearest(const Vec3& x) const {
    Found best;
    period_.forImagesWithin(x, low_, high_, [&](const Vec3& image) {
        const SurfacePoint at = grid_.nearest(image);
        if (at && (!best || std::abs(at.distance) < std::abs(best.at.distance))) best = {at, image};
    });
    return best;
}

PeriodicSurface::Place PeriodicSurface::at(const Vec3& x) const {
    if (const NearestImages::Found found = images_.nearest(x)) return {found.at.distance, found.image};
    if (const std::optional<Vec3> image = inside_.imageInside(x, period_)) return {-grid_.reach(), *image};
    return {std::numeric_limits<double>::infinity(), x};
}

}  // namespace corpuscle::geometry
