#include "sph/kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "sph/samples.hpp"

using namespace corpuscle;
using namespace corpuscle::sph;
using corpuscle::sph::testing::choose;

namespace {
const char* const names[] = {"lucy", "wendlandC2", "quintic"};
}

// Lattice limits from docs/theory/timeStep.md, in dx^2/nu.
TEST(Kernels, viscousRateOnALattice) {
    const std::tuple<const char*, double, double> known[] = {{"lucy", 2.6, 0.3261},
                                                             {"wendlandC2", 2.8, 0.2881},
                                                             {"wendlandC2", 2.4, 0.2171},
                                                             {"quintic", 2.5, 0.18},
                                                             {"quintic", 2.8, 0.22}};
    for (const auto& [name, support, limit] : known)
        EXPECT_NEAR(1 / choose<Kernel>(name)->viscousRate(support), limit, name[0] == 'q' ? 0.005 : 1e-4) << name;
}

TEST(Kernels, integrateToOneOverTheirSupport) {
    for (const char* name : names) {
        const auto kernel = choose<Kernel>(name);
        for (const double H : {1.0, 2.5e-6}) {
            const int n = 3000;  // Simpson's rule; multiples of 3 put the breakpoints of the quintic on nodes
            double sum = 0;
            for (int i = 0; i <= n; ++i) {
                const double q = static_cast<double>(i) / n, weight = i == 0 || i == n ? 1 : (i % 2 ? 4 : 2);
                sum += weight * 4 * std::numbers::pi * q * q * kernel->value(q);
            }
            EXPECT_NEAR(sum / (3 * n) * H * H * H * kernel->normalisation(H), 1, 1e-9) << name;
        }
    }
}

TEST(Kernels, slopeIsTheDerivativeOverTheDistance) {
    for (const char* name : names) {
        const auto kernel = choose<Kernel>(name);
        const double H = 2.7, step = 1e-6;
        for (double q = 0.013; q < 1.2; q += 0.0371) {
            const double derivative =
                (kernel->value(q + step) - kernel->value(q - step)) / (2 * step * H) * kernel->normalisation(H);
            const double slope = kernel->gradientNormalisation(H) * kernel->slope(q);
            EXPECT_NEAR(-derivative / (q * H), slope, 2e-8 * kernel->gradientNormalisation(H) * kernel->slope(0.2))
                << name << " q " << q;
        }
        EXPECT_EQ(kernel->value(1), 0);
        EXPECT_EQ(kernel->slope(1), 0);
        EXPECT_EQ(kernel->value(1.3), 0);
        EXPECT_EQ(kernel->slope(1.3), 0);
        EXPECT_TRUE(std::isfinite(kernel->slope(0)));
    }
}

// S2 - 1 in per cent, and number of neighbours, on the cubic lattice. Source: computed by direct summation for this
// project, independently of this code; rounded to one decimal (two below 0.1).
TEST(Kernels, secondMomentsOnTheLattice) {
    struct Row {
        double support, lucy, wendland, quintic;
        int neighbours;
    };
    const Row rows[] = {{2.0, 4.2, -1.8, -13.6, 27},   {2.4, -3.7, -1.5, -1.5, 57}, {2.5, -3.3, -2.1, -0.6, 81},
                        {2.6, -1.2, -2.1, -0.3, 81},   {2.8, 1.6, -0.9, -0.02, 81}, {3.0, 0.7, 0.06, 0.10, 93},
                        {3.2, -0.6, -0.01, 0.07, 147}, {3.5, -0.2, -0.3, -0.1, 179}};
    const auto tolerance = [](double v) { return std::abs(v) <= 0.1 ? (std::abs(v) == 0.1 ? 0.06 : 0.006) : 0.06; };
    for (const Row& row : rows) {
        const double expected[] = {row.lucy, row.wendland, row.quintic};
        for (int k = 0; k < 3; ++k) {
            const auto kernel = choose<Kernel>(names[k]);
            EXPECT_NEAR(100 * (kernel->secondMoment(row.support) - 1), expected[k], tolerance(expected[k]))
                << names[k] << " at " << row.support;
            EXPECT_EQ(kernel->latticeNeighbours(row.support), row.neighbours) << row.support;
        }
    }
}

TEST(Kernels, supportIsReadInSpacings) {
    EXPECT_EQ(choose<Kernel>("{type: lucy, support: 2.5 dx}")->kind(), Kernels::kindOf<Lucy>());
    EXPECT_EQ(choose<Kernel>("quintic")->kind(), Kernels::kindOf<Quintic>());
    EXPECT_ANY_THROW(choose<Kernel>("cubic"));
    EXPECT_ANY_THROW(choose<Kernel>("{type: lucy, support: -1 dx}"));
}
