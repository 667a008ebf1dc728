// Order of particles in space and memory. Space is divided into columns along z of square cross-section, which are
// numbered along a serpentine path, so that consecutive columns are neighbours. Particles are sorted by z within a
// column, downwards in every second one. Any few consecutive particles are therefore close together, across the end of
// a column too, and no column needs padding.
#pragma once
#include <algorithm>
#include <vector>

#include "particles/particleStore.hpp"

namespace corpuscle::particles {

class Columns {
  public:
    Columns() = default;
    // Columns of about `width` over the rectangle [xLow, xHigh] x [yLow, yHigh].
    Columns(double xLow, double xHigh, double yLow, double yHigh, double width);

    int columnCount() const { return nx_ * ny_; }

    // The order that sorts the particles: order[k] is the particle that comes k-th. The sort is stable.
    std::vector<int> sort(const double* x, const double* y, const double* z, int n);
    // First particle of a column, and one past its last, once the particles have been put into that order.
    int begin(int column) const { return start_[static_cast<std::size_t>(column)]; }
    int end(int column) const { return start_[static_cast<std::size_t>(column) + 1]; }

    // Storage number of the column at grid position (cx, cy).
    int column(int cx, int cy) const { return cx * ny_ + (cx % 2 ? ny_ - 1 - cy : cy); }
    static bool downwards(int column) { return column % 2 == 1; }
    int cellX(double x) const { return clampCell((x - xLow_) * inverseX_, nx_); }
    int cellY(double y) const { return clampCell((y - yLow_) * inverseY_, ny_); }
    // Distance from the interval [a, b] to the column strip at cx or cy (0 if they overlap).
    double gapX(int cx, double a, double b) const { return gap(cx, nx_, xLow_, widthX_, a, b); }
    double gapY(int cy, double a, double b) const { return gap(cy, ny_, yLow_, widthY_, a, b); }

    // The particles of a column with z in [zLow, zHigh], as an index range; z is the sorted array. The search starts
    // from `near`, the result for a neighbouring query: the result is right for any `near`, and found fast for a close
    // one.
    struct Span {
        int begin = 0, end = 0;
    };
    Span between(int column, const double* z, double zLow, double zHigh, Span near) const {
        const int first = begin(column), last = end(column);
        int a = near.begin < first ? first : near.begin > last ? last : near.begin;
        int b = near.end < first ? first : near.end > last ? last : near.end;
        if (downwards(column)) {
            while (a > first && z[a - 1] <= zHigh) --a;
            while (a < last && z[a] > zHigh) ++a;
            while (b > first && z[b - 1] < zLow) --b;
            while (b < last && z[b] >= zLow) ++b;
        } else {
            while (a > first && z[a - 1] >= zLow) --a;
            while (a < last && z[a] < zLow) ++a;
            while (b > first && z[b - 1] > zHigh) --b;
            while (b < last && z[b] <= zHigh) ++b;
        }
        return {a, b};
    }

    // f(i) for all particles of the columns within `radius` of x along x and y whose z is within `radius` of x[2]; z is
    // the sorted array.
    template <class F>
    void forNear(const double* z, const Vec3& x, double radius, F&& f) const {
        const int x0 = cellX(x[0] - radius), x1 = cellX(x[0] + radius), y0 = cellY(x[1] - radius),
                  y1 = cellY(x[1] + radius);
        const double zLow = x[2] - radius, zHigh = x[2] + radius;
        for (int cx = x0; cx <= x1; ++cx)
            for (int cy = y0; cy <= y1; ++cy) {
                const int c = column(cx, cy);
                const double *first = z + begin(c), *last = z + end(c), *from = nullptr, *to = nullptr;
                if (downwards(c)) {
                    from = std::partition_point(first, last, [&](double a) { return a > zHigh; });
                    to = std::partition_point(from, last, [&](double a) { return a >= zLow; });
                } else {
                    from = std::partition_point(first, last, [&](double a) { return a < zLow; });
                    to = std::partition_point(from, last, [&](double a) { return a <= zHigh; });
                }
                for (; from != to; ++from) f(static_cast<int>(from - z));
            }
    }

  private:
    // The outermost strips reach to infinity.
    static double gap(int c, int count, double low, double width, double a, double b) {
        const double below = c == 0 ? 0 : low + c * width - b;
        const double above = c == count - 1 ? 0 : a - (low + (c + 1) * width);
        return std::max({0.0, below, above});
    }
    static int clampCell(double c, int n) {
        if (!(c > 0)) return 0;
        return c >= n ? n - 1 : static_cast<int>(c);
    }
    double xLow_ = 0, yLow_ = 0, widthX_ = 1, widthY_ = 1, inverseX_ = 1, inverseY_ = 1;
    int nx_ = 1, ny_ = 1;
    std::vector<int> start_{0, 0};
};

}  // namespace corpuscle::particles
