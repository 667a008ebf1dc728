#include "geometry/distanceField.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/insideTest.hpp"
#include "geometry/triangleTree.hpp"

namespace corpuscle::geometry {

DistanceField::DistanceField(const TriangleMesh& mesh, double spacing, double reach)
    : low_(mesh.nodes.front()), spacing_(spacing), reach_(reach) {
    Vec3 high = low_;
    for (const Vec3& x : mesh.nodes) low_ = low_.cwiseMin(x), high = high.cwiseMax(x);
    low_.array() -= reach;
    std::size_t all = 1;
    for (int k = 0; k < 3; ++k) {
        count_[k] = static_cast<int>(std::ceil((high[k] + reach - low_[k]) / spacing)) + 1;
        all *= static_cast<std::size_t>(count_[k]);
    }
    // Interpolation up to the reach needs exact distances at nodes beyond it.
    const TriangleTree surface(mesh, reach + std::sqrt(3.0) * spacing);
    const InsideTest inside(mesh);
    values_.reserve(all);
    for (int k = 0; k < count_[2]; ++k)
        for (int j = 0; j < count_[1]; ++j)
            for (int i = 0; i < count_[0]; ++i) {
                const Vec3 x = low_ + spacing * Vec3(i, j, k);
                const SurfacePoint nearest = surface.nearest(x);
                const double distance = nearest ? nearest.distance : inside.inside(x) ? -2 * reach : 2 * reach;
                values_.push_back(static_cast<float>(distance / reach));
            }
}

double DistanceField::at(const Vec3& x) const {
    Index3 cell{};
    double part[3];
    for (int k = 0; k < 3; ++k) {
        const double place = (x[k] - low_[k]) / spacing_;
        if (!(place >= 0 && place < count_[k] - 1)) return reach_;
        cell[k] = static_cast<int>(place);
        part[k] = place - cell[k];
    }
    const auto value = [&](int i, int j, int k) {
        const auto n = static_cast<std::size_t>(cell[2] + k) * static_cast<std::size_t>(count_[1]);
        return static_cast<double>(
            values_[(n + static_cast<std::size_t>(cell[1] + j)) * static_cast<std::size_t>(count_[0]) +
                    static_cast<std::size_t>(cell[0] + i)]);
    };
    const auto along = [&](int j, int k) { return (1 - part[0]) * value(0, j, k) + part[0] * value(1, j, k); };
    const auto across = [&](int k) { return (1 - part[1]) * along(0, k) + part[1] * along(1, k); };
    return reach_ * std::clamp((1 - part[2]) * across(0) + part[2] * across(1), -1.0, 1.0);
}

}  // namespace corpuscle::geometry
