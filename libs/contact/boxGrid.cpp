#include "contact/boxGrid.hpp"

#include <algorithm>

namespace corpuscle::contact {

BoxGrid::BoxGrid(const std::vector<geometry::Bounds>& boxes) : boxes_(boxes), asked_(boxes.size(), 0) {
    if (boxes.empty()) return;
    chooseCubes();
    begin_.assign(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2] + 1, 0);
    for (const geometry::Bounds& box : boxes_) forCubes(box, [&](std::size_t at) { ++begin_[at + 1]; });
    for (std::size_t at = 1; at < begin_.size(); ++at) begin_[at] += begin_[at - 1];
    entries_.resize(begin_.back());
    std::vector<int> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t n = 0; n < boxes_.size(); ++n)
        forCubes(boxes_[n], [&](std::size_t at) { entries_[next[at]++] = static_cast<int>(n); });
}

Index3 BoxGrid::cube(const Vec3& x) const {
    Index3 at{};
    for (int k = 0; k < 3; ++k)
        at[k] = static_cast<int>(std::clamp((x[k] - all_.min()[k]) / size_, 0.0, count_[k] - 1.0));
    return at;
}

template <class F>
void BoxGrid::forCubes(const geometry::Bounds& box, F&& f) const {
    const Index3 low = cube(box.min()), high = cube(box.max());
    for (int i = low[0]; i <= high[0]; ++i)
        for (int j = low[1]; j <= high[1]; ++j)
            for (int k = low[2]; k <= high[2]; ++k) f(index(i, j, k));
}

double BoxGrid::entries() const {
    double sum = 0;
    for (const geometry::Bounds& box : boxes_) {
        const Index3 low = cube(box.min()), high = cube(box.max());
        double cubes = 1;
        for (int k = 0; k < 3; ++k) cubes *= high[k] - low[k] + 1;
        sum += cubes;
    }
    return sum;
}

void BoxGrid::chooseCubes() {
    double extent = 0;
    for (const geometry::Bounds& box : boxes_) {
        all_.extend(box);
        extent += box.sizes().maxCoeff();
    }
    const double longest = all_.sizes().maxCoeff();
    const auto number = static_cast<double>(boxes_.size());
    size_ = std::max({extent / number, 1e-6 * longest, 1e-300});
    for (;; size_ *= 1.5) {
        double cubes = 1;
        for (int k = 0; k < 3; ++k) {
            const double along = std::floor(all_.sizes()[k] / size_) + 1;
            cubes *= along;
            count_[k] = static_cast<int>(along);
        }
        if (cubes <= perBox * number + 64 && entries() <= perBox * number + 64) return;
    }
}

}  // namespace corpuscle::contact
