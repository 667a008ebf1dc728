// The cases that each sampling produces, counted and checked one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "study/gridSampling.hpp"
#include "study/latinHypercube.hpp"
#include "study/zipSampling.hpp"

namespace corpuscle::study {
namespace {

// The level of each parameter in each case.
std::vector<std::vector<int>> levelsOf(const Sampling& sampling, const std::vector<std::size_t>& levels) {
    std::vector<std::vector<int>> all;
    for (const auto& point : sampling.points(levels)) {
        all.emplace_back();
        for (std::size_t k = 0; k < levels.size(); ++k)
            all.back().push_back(static_cast<int>(std::floor(point[k] * static_cast<double>(levels[k]))));
    }
    return all;
}

TEST(Samplings, GridHasEveryCombinationOnce) {
    const std::vector<std::vector<int>> wanted{{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 1}, {1, 2}};
    EXPECT_EQ(levelsOf(GridSampling{}, {2, 3}), wanted);
    const auto large = levelsOf(GridSampling{}, {7, 5, 11});
    EXPECT_EQ(std::set<std::vector<int>>(large.begin(), large.end()).size(), 7u * 5 * 11);
    EXPECT_NE(GridSampling{}.refusal({"a", "b"}, {2, 0}).find("'b' has a range and no 'count'"), std::string::npos);
    EXPECT_EQ(GridSampling{}.refusal({"a", "b"}, {2, 3}), "");
}

TEST(Samplings, ZipTakesValuesSideBySide) {
    const std::vector<std::vector<int>> wanted{{0, 0}, {1, 1}, {2, 2}};
    EXPECT_EQ(levelsOf(ZipSampling{}, {3, 3}), wanted);
    EXPECT_NE(ZipSampling{}.refusal({"a", "b"}, {3, 2}).find("'a' has 3 values and 'b' has 2"), std::string::npos);
}

TEST(Samplings, LatinHypercubeUsesEachPartOfEachRangeOnce) {
    LatinHypercube sampling;
    sampling.samples = 40;
    const auto points = sampling.points({0, 0, 4});
    ASSERT_EQ(points.size(), 40u);
    for (std::size_t k = 0; k < 3; ++k) {
        std::set<int> parts;
        for (const auto& point : points) {
            EXPECT_GE(point[k], 0);
            EXPECT_LT(point[k], 1);
            parts.insert(static_cast<int>(point[k] * 40));
        }
        EXPECT_EQ(parts.size(), 40u);
    }
    // Parameters are drawn independently: the correlation of 40 pairs is below 0.5 with odds of about 1000 to 1.
    double product = 0;
    for (const auto& point : points) product += (point[0] - 0.5) * (point[1] - 0.5) * 12 / 40;
    EXPECT_LT(std::abs(product), 0.5);
    EXPECT_EQ(points, sampling.points({0, 0, 4}));
    sampling.seed = 2;
    EXPECT_NE(points, sampling.points({0, 0, 4}));
}

}  // namespace
}  // namespace corpuscle::study
