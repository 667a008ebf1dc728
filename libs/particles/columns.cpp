#include "particles/columns.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle::particles {

Columns::Columns(double xLow, double xHigh, double yLow, double yHigh, double width) : xLow_(xLow), yLow_(yLow) {
    // The outermost columns reach to infinity (clampCell): particles may lie outside the rectangle.
    nx_ = std::max(1, static_cast<int>((xHigh - xLow) / width + 1e-9));
    ny_ = std::max(1, static_cast<int>((yHigh - yLow) / width + 1e-9));
    widthX_ = std::max((xHigh - xLow) / nx_, 1e-300);
    widthY_ = std::max((yHigh - yLow) / ny_, 1e-300);
    inverseX_ = 1 / widthX_;
    inverseY_ = 1 / widthY_;
    start_.assign(static_cast<std::size_t>(nx_ * ny_) + 1, 0);
}

std::vector<int> Columns::sort(const double* x, const double* y, const double* z, int n) {
    const auto count = static_cast<std::size_t>(n);
    std::vector<int> key(count), order(count);
    std::fill(start_.begin(), start_.end(), 0);
    for (int i = 0; i < n; ++i) {
        key[i] = column(cellX(x[i]), cellY(y[i]));
        ++start_[static_cast<std::size_t>(key[i]) + 1];
    }
    for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    std::vector<int> next(start_.begin(), start_.end() - 1);
    for (int i = 0; i < n; ++i) order[next[key[i]]++] = i;

    // After the first call particles are nearly sorted already: insertion sort, and std::stable_sort for a column that
    // is far from sorted.
    for (int c = 0; c < columnCount(); ++c) {
        int* first = order.data() + begin(c);
        const int m = end(c) - begin(c);
        const double sign = downwards(c) ? -1 : 1;
        long moves = 0;
        const long limit = 8L * m + 64;
        for (int i = 1; i < m && moves <= limit; ++i) {
            const int particle = first[i];
            const double height = sign * z[particle];
            int k = i;
            for (; k > 0 && sign * z[first[k - 1]] > height; --k) first[k] = first[k - 1];
            first[k] = particle;
            moves += i - k;
        }
        if (moves > limit) std::stable_sort(first, first + m, [&](int a, int b) { return sign * z[a] < sign * z[b]; });
    }
    return order;
}

}  // namespace corpuscle::particles
