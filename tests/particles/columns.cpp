#include "particles/columns.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

using corpuscle::particles::Columns;

namespace {

struct Points {
    std::vector<double> x, y, z;
    int count() const { return static_cast<int>(x.size()); }
    Points ordered(const std::vector<int>& order) const {
        Points p;
        for (const int i : order) p.x.push_back(x[i]), p.y.push_back(y[i]), p.z.push_back(z[i]);
        return p;
    }
};

// Some points lie outside the rectangle 0..7 x 0..5, and several have the same height.
Points scattered(int n) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> x(-1, 8), y(-1, 6);
    std::uniform_int_distribution<int> z(-40, 40);
    Points p;
    for (int i = 0; i < n; ++i) p.x.push_back(x(random)), p.y.push_back(y(random)), p.z.push_back(0.25 * z(random));
    return p;
}

}  // namespace

TEST(Columns, orderIsAPermutationSortedInEachColumnAndStable) {
    const Points p = scattered(3000);
    Columns columns(0, 7, 0, 5, 2);
    const std::vector<int> order = columns.sort(p.x.data(), p.y.data(), p.z.data(), p.count());
    EXPECT_EQ(std::set<int>(order.begin(), order.end()).size(), 3000u);
    EXPECT_EQ(columns.begin(0), 0);
    EXPECT_EQ(columns.end(columns.columnCount() - 1), 3000);
    int inside = 0;
    for (int c = 0; c < columns.columnCount(); ++c)
        for (int k = columns.begin(c); k < columns.end(c); ++k, ++inside) {
            const int i = order[k];
            EXPECT_EQ(columns.column(columns.cellX(p.x[i]), columns.cellY(p.y[i])), c);
            if (k == columns.begin(c)) continue;
            const int before = order[k - 1];
            const double rise = Columns::downwards(c) ? p.z[before] - p.z[i] : p.z[i] - p.z[before];
            EXPECT_GE(rise, 0);
            if (rise == 0) {
                EXPECT_LT(before, i) << "equal particles keep their order";
            }
        }
    EXPECT_EQ(inside, 3000);

    // Sorting particles that are already sorted changes nothing.
    Points again = p.ordered(order);
    const std::vector<int> same = columns.sort(again.x.data(), again.y.data(), again.z.data(), 3000);
    for (int k = 0; k < 3000; ++k) EXPECT_EQ(same[k], k);
}

TEST(Columns, neighbouringColumnsAreNeighboursInMemory) {
    const Columns columns(0, 7, 0, 5, 1);
    int x = 0, y = 0;
    for (int k = 1; k < columns.columnCount(); ++k) {
        int nx = -1, ny = -1;
        for (int cx = 0; cx < 7; ++cx)
            for (int cy = 0; cy < 5; ++cy)
                if (columns.column(cx, cy) == k) nx = cx, ny = cy;
        EXPECT_EQ(std::abs(nx - x) + std::abs(ny - y), 1);
        x = nx, y = ny;
    }
}

TEST(Columns, spanHoldsExactlyTheParticlesBetweenTwoHeights) {
    Columns columns(0, 7, 0, 5, 2);
    const Points scatter = scattered(600);
    const Points p = scatter.ordered(columns.sort(scatter.x.data(), scatter.y.data(), scatter.z.data(), 600));
    for (int c = 0; c < columns.columnCount(); ++c)
        for (double low = -11; low < 11; low += 1.25)
            for (const double high : {low, low + 0.25, low + 3.1}) {
                for (const Columns::Span near :
                     {Columns::Span{0, 0}, {600, 600}, {columns.begin(c) + 3, columns.begin(c) + 1}, {-5, 300}}) {
                    const Columns::Span span = columns.between(c, p.z.data(), low, high, near);
                    for (int k = columns.begin(c); k < columns.end(c); ++k)
                        EXPECT_EQ(k >= span.begin && k < span.end, p.z[k] >= low && p.z[k] <= high);
                }
            }
}

TEST(Columns, gapsAreDistancesToTheColumnAndOuterColumnsReachOn) {
    const Columns columns(0, 8, 0, 4, 2);
    EXPECT_DOUBLE_EQ(columns.gapX(1, 5, 6), 1);
    EXPECT_DOUBLE_EQ(columns.gapX(2, 1, 1.5), 2.5);
    EXPECT_DOUBLE_EQ(columns.gapX(1, 3, 9), 0);
    EXPECT_DOUBLE_EQ(columns.gapX(0, -9, -8), 0);
    EXPECT_DOUBLE_EQ(columns.gapX(3, 11, 12), 0);
    EXPECT_DOUBLE_EQ(columns.gapY(1, -3, -1), 3);
    EXPECT_DOUBLE_EQ(columns.gapY(1, 9, 10), 0);
}
