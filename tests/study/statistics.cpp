// Statistics of series for which they are known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "study/crossingStatistic.hpp"
#include "study/extremeStatistic.hpp"
#include "study/lastStatistic.hpp"
#include "study/maximumStatistic.hpp"
#include "study/meanStatistic.hpp"
#include "study/minimumStatistic.hpp"
#include "study/periodStatistic.hpp"
#include "study/tableSelection.hpp"

namespace corpuscle::study {
namespace {

struct Wave {
    std::vector<double> along, values;
    Wave(double period, double length, double noise = 0) {
        for (double s = 0; s < length; s += 0.05) {
            along.push_back(s);
            const double ripple = noise * std::sin(60 * s);  // the ripple alone crosses the mean many times
            values.push_back(0.4 + 0.1 * std::sin(2 * std::numbers::pi * s / period) + ripple);
        }
    }
};

TEST(Statistics, PeriodOfAWave) {
    const Wave wave(7.3, 40);
    const Estimate period = PeriodStatistic{}.of(wave.along, wave.values);
    EXPECT_NEAR(period.value, 7.3, 0.01);
    EXPECT_LT(period.error, 0.01);
    EXPECT_TRUE(period.isReliable);
}

TEST(Statistics, NoiseAroundTheMeanIsNoPeriod) {
    const Wave wave(7.3, 40, 0.009);  // 5 % of the range is 0.011
    const Estimate period = PeriodStatistic{}.of(wave.along, wave.values);
    EXPECT_NEAR(period.value, 7.3, 0.2);
    EXPECT_GT(period.error, 1e-4);
}

TEST(Statistics, TooFewPeriodsAreNone) {
    const Wave one(7.3, 8), two(7.3, 16);
    EXPECT_TRUE(std::isnan(PeriodStatistic{}.of(one.along, one.values).value));
    const Estimate period = PeriodStatistic{}.of(two.along, two.values);
    EXPECT_NEAR(period.value, 7.3, 0.01);
    EXPECT_FALSE(period.isReliable);
    const std::vector<double> flat(5, 1.0), times{0, 1, 2, 3, 4};
    EXPECT_TRUE(std::isnan(PeriodStatistic{}.of(times, flat).value));
}

TEST(Statistics, CrossingFromEitherSide) {
    const std::vector<double> along{0, 1, 2, 3}, up{0, 0.5, 2, 3}, down{3, 2, 0.5, 0};
    CrossingStatistic crossing;
    crossing.level = 1;
    EXPECT_NEAR(crossing.of(along, up).value, 1 + 0.5 / 1.5, 1e-14);
    EXPECT_NEAR(crossing.of(along, down).value, 1 + 1 / 1.5, 1e-14);
    crossing.level = 3;
    EXPECT_EQ(crossing.of(along, up).value, 3);
    EXPECT_EQ(crossing.of(along, down).value, 0);
    crossing.level = 4;
    EXPECT_TRUE(std::isnan(crossing.of(along, up).value));
}

TEST(Statistics, LastAndExtremes) {
    const std::vector<double> along{0, 1, 2}, values{2, -1, 1};
    EXPECT_EQ(LastStatistic{}.of(along, values).value, 1);
    EXPECT_EQ(MinimumStatistic{}.of(along, values).value, -1);
    EXPECT_EQ(MaximumStatistic{}.of(along, values).value, 2);
    EXPECT_TRUE(std::isnan(LastStatistic{}.of(along, values).error));
    EXPECT_EQ(ExtremeStatistic{}.of(along, std::vector<double>{1, -3, 2}).value, -3);
}

TEST(Statistics, MeanHasAnErrorThatCoversTheTruth) {
    const Wave wave(3, 300);
    const Estimate mean = MeanStatistic{}.of(wave.along, wave.values);
    EXPECT_NEAR(mean.value, 0.4, 4 * mean.error + 1e-12);
    const std::vector<double> constant(30, 0.1), along(30, 0.0);
    EXPECT_TRUE(MeanStatistic{}.of(along, constant).isReliable);
}

TEST(Tables, SeriesOfCellsPlacesAndRanges) {
    io::CsvTable cells{{"time_s", "strain", "cell", "D"}, {}};
    for (int k = 0; k <= 10; ++k)
        for (int cell = 1; cell <= 3; ++cell) cells.rows.push_back({0.1 * k, 2.0 * k, 1.0 * cell, 1.0 * k + cell});
    const TableSelection half = selectFrom(cells, "a/b", std::nullopt, std::nullopt, {"D"});
    EXPECT_EQ(half.along, "strain");
    EXPECT_EQ(half.moments, (std::vector<double>{10, 12, 14, 16, 18, 20}));
    EXPECT_EQ(half.series.at(0).at("D"), (std::vector<double>{7, 8, 9, 10, 11, 12}));
    const TableSelection part = selectFrom(cells, "a/b", Moment::parse("200 ms"), Moment::parse("8 strain"), {});
    EXPECT_EQ(part.moments.size(), 3u);
    EXPECT_EQ(selectFrom(cells, "a/b", std::nullopt, std::nullopt, {"D"}, true).moments.size(), 11u);
    EXPECT_THROW(selectFrom(cells, "a/b", std::nullopt, std::nullopt, {"E"}), Failure);
    EXPECT_THROW(selectFrom(cells, "a/b", Moment::parse("30 strain"), std::nullopt, {"D"}), Failure);

    io::CsvTable uneven{{"time_s", "D"}, {{0, 1}, {1, 1}, {2, 1}, {2.5, 1}}};
    TableSelection all = selectFrom(uneven, "a/b", std::nullopt, std::nullopt, {}, true);
    EXPECT_EQ(all.along, "time_s");
    EXPECT_EQ(requireEvenSpacing(all, "a/b"), 1);  // the last row, at the end of the run, is left out
    EXPECT_EQ(all.moments.size(), 3u);
    EXPECT_EQ(all.series.at(0).at("D").size(), 3u);
    uneven.rows.push_back({3, 1});
    all = selectFrom(uneven, "a/b", std::nullopt, std::nullopt, {}, true);
    EXPECT_THROW(requireEvenSpacing(all, "a/b"), Failure);
    EXPECT_THROW(Moment::parse("5"), std::invalid_argument);
    EXPECT_THROW(Moment::parse("5 um"), std::invalid_argument);
}

}  // namespace
}  // namespace corpuscle::study
