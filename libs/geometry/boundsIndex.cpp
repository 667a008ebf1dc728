#include "geometry/boundsIndex.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle::geometry {

namespace {
constexpr int mostAlong = 128;  // cuboids along an axis
}  // namespace

BoundsIndex::BoundsIndex(const std::vector<Bounds>& bounds, const Vec3& low, const Vec3& high,
                         const Periodicity& period, double margin)
    : low_(low), size_(high - low), period_(period) {
    Vec3 mean = Vec3::Zero();
    double count = 0;
    for (const Bounds& b : bounds)
        if (!b.isEmpty()) mean += b.sizes() + Vec3::Constant(2 * margin), ++count;
    if (count == 0) return;
    mean /= count;
    for (int k = 0; k < 3; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        periodic_[axis] = period.isAlong(k) && k != period.slidingAxis();
        count_[axis] = static_cast<int>(
            std::clamp(std::floor(size_[k] / std::max(mean[k], 1e-300)), 1.0, static_cast<double>(mostAlong)));
        size_[k] /= count_[axis];
    }
    surfaces_.assign(
        static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) * static_cast<std::size_t>(count_[2]),
        {});
    for (std::size_t s = 0; s < bounds.size(); ++s) {
        if (bounds[s].isEmpty()) continue;
        const Bounds grown(bounds[s].min() - Vec3::Constant(margin), bounds[s].max() + Vec3::Constant(margin));
        if (!period.slides()) {
            add(static_cast<int>(s), grown);
            continue;
        }
        const int k = period.slidingAxis();
        const double length = period.lengths()[k];
        const int first = static_cast<int>(std::ceil((low[k] - grown.max()[k]) / length)),
                  last = static_cast<int>(std::floor((high[k] - grown.min()[k]) / length));
        for (int n = first; n <= last; ++n)
            add(static_cast<int>(s), grown.translated(Vec3(n * (length * Vec3::Unit(k) + period.offset()))));
    }
}

void BoundsIndex::add(int surface, const Bounds& bounds) {
    Index3 from = cuboid(bounds.min()), to = cuboid(bounds.max());
    for (std::size_t k = 0; k < 3; ++k) {
        if (!periodic_[k])
            from[k] = std::clamp(from[k], 0, count_[k] - 1), to[k] = std::clamp(to[k], 0, count_[k] - 1);
        else
            to[k] = std::min(to[k], from[k] + count_[k] - 1);  // each cuboid once
    }
    for (int a = from[0]; a <= to[0]; ++a)
        for (int b = from[1]; b <= to[1]; ++b)
            for (int c = from[2]; c <= to[2]; ++c) {
                std::vector<int>& here = surfaces_[index({a, b, c})];
                if (here.empty() || here.back() != surface) here.push_back(surface);
            }
}

const std::vector<int>& BoundsIndex::near(const Vec3& x) const {
    static const std::vector<int> none;
    if (!x.allFinite()) return none;
    return surfaces_[index(cuboid(period_.slides() ? period_.wrap(x) : x))];
}

Index3 BoundsIndex::cuboid(const Vec3& x) const {
    Index3 at{};
    for (int k = 0; k < 3; ++k) {
        const double n = std::floor((x[k] - low_[k]) / size_[k]);
        at[static_cast<std::size_t>(k)] = static_cast<int>(std::clamp(n, -1e9, 1e9));
    }
    return at;
}

std::size_t BoundsIndex::index(const Index3& cuboid) const {
    std::size_t at = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const int n = count_[k];
        const int wrapped = periodic_[k] ? ((cuboid[k] % n) + n) % n : std::clamp(cuboid[k], 0, n - 1);
        at = at * static_cast<std::size_t>(n) + static_cast<std::size_t>(wrapped);
    }
    return at;
}

std::vector<std::vector<std::size_t>> pointsNear(const std::vector<Vec3>& points,
                                                 const std::vector<TriangleMesh>& meshes, double margin,
                                                 const Periodicity& period) {
    std::vector<std::vector<std::size_t>> near(meshes.size());
    if (points.empty()) return near;
    Bounds box;
    for (const Vec3& x : points) box.extend(x);
    for (int k = 0; k < 3; ++k)  // along a periodic axis, one whole period
        if (period.isAlong(k)) box.max()[k] = box.min()[k] + period.lengths()[k];
    std::vector<Bounds> bounds;
    bounds.reserve(meshes.size());
    for (const TriangleMesh& mesh : meshes) bounds.push_back(boundsOf(mesh.nodes));
    const BoundsIndex index(bounds, box.min(), box.max(), period, margin);
    for (std::size_t i = 0; i < points.size(); ++i)
        for (const int m : index.near(points[i])) near[static_cast<std::size_t>(m)].push_back(i);
    return near;
}

}  // namespace corpuscle::geometry
