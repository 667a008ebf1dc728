// Block averages of series whose standard error is known: independent values, and values correlated with the previous
// one.
#include "core/blockAverage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace corpuscle {
namespace {

// x_k = memory x_(k-1) + noise, started in its stationary state, mean 3, variance 1. The mean of n values has the
// variance (1 + memory)/((1 - memory) n), for n far above 1/(1 - memory).
std::vector<double> remembering(double memory, std::size_t n, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::vector<double> series(n);
    double x = normal(random);
    for (double& value : series) {
        value = 3 + x;
        x = memory * x + std::sqrt(1 - memory * memory) * normal(random);
    }
    return series;
}

struct Remembered {
    double memory;
    std::size_t values;
};

class Blocks : public testing::TestWithParam<Remembered> {};

TEST_P(Blocks, errorIsThatOfTheMean) {
    const auto [memory, n] = GetParam();
    constexpr int trials = 400;
    const double exact = (1 + memory) / ((1 - memory) * static_cast<double>(n));
    double square = 0;
    int within = 0, reliable = 0;
    for (unsigned trial = 0; trial < trials; ++trial) {
        const BlockAverage found = blockAverage(remembering(memory, n, trial + 1));
        square += found.error * found.error / trials;
        within += std::abs(found.mean - 3) < 2 * found.error ? 1 : 0;
        reliable += found.isReliable ? 1 : 0;
        EXPECT_EQ(found.values, static_cast<long>(n));
    }
    EXPECT_NEAR(square / exact, 1, 0.15);
    EXPECT_GT(within, 0.90 * trials) << "of 95.4 %";
    EXPECT_LT(within, 0.99 * trials);
    EXPECT_GT(reliable, 0.95 * trials);
}

INSTANTIATE_TEST_SUITE_P(series, Blocks,
                         testing::Values(Remembered{0, 500}, Remembered{0, 1000}, Remembered{0.5, 2000},
                                         Remembered{0.9, 4096}, Remembered{0.95, 10000}));

TEST(BlockAverage, saysHowManyValuesAreIndependent) {
    const BlockAverage one = blockAverage(remembering(0, 4096, 1)), other = blockAverage(remembering(0.9, 1 << 16, 1));
    EXPECT_NEAR(one.independent, 4096, 500);
    EXPECT_NEAR(other.independent, (1 << 16) * 0.1 / 1.9, 700);
}

TEST(BlockAverage, ofTooFewValuesIsNotReliable) {
    int reliable = 0;
    double square = 0;
    constexpr unsigned trials = 200;
    for (unsigned trial = 0; trial < trials; ++trial) {
        const BlockAverage found = blockAverage(remembering(0.95, 64, trial + 1));
        reliable += found.isReliable ? 1 : 0;
        square += found.error * found.error / trials;
    }
    EXPECT_LT(reliable, 0.25 * trials);
    EXPECT_GT(square, 5.0 / 64) << "far above that of independent values, though below the true 39/64";
    for (const std::size_t n : {1U, 2U, 7U}) EXPECT_FALSE(blockAverage(remembering(0, n, 1)).isReliable) << n;
}

TEST(BlockAverage, ofADriftIsNotReliable) {
    std::vector<double> drift = remembering(0, 256, 1);
    for (std::size_t k = 0; k < drift.size(); ++k) drift[k] += 0.05 * static_cast<double>(k);
    EXPECT_FALSE(blockAverage(drift).isReliable);
}

TEST(BlockAverage, ofAConstantHasNoError) {
    const BlockAverage found = blockAverage(std::vector<double>(20, 1.25));
    EXPECT_EQ(found.mean, 1.25);
    EXPECT_EQ(found.error, 0);
    EXPECT_TRUE(found.isReliable);
    EXPECT_EQ(blockAverage(std::vector<double>{7}).mean, 7);
    EXPECT_THROW(blockAverage({}), std::invalid_argument);
}

}  // namespace
}  // namespace corpuscle
