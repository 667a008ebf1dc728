// Time steps that end exactly at events, and the summed strain.
#include "core/time.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace corpuscle {
namespace {

struct Walk {
    std::vector<double> ends;  // strain after each step
    double shortest = 1e300, longest = 0;
};

// Makes steps like a solver, each as long as the limits allow, until the end.
Walk walk(Time time, const std::vector<Interval>& intervals) {
    std::vector<Ticker> tickers;
    tickers.reserve(intervals.size());
    for (const Interval& interval : intervals) tickers.emplace_back(interval, time);
    Walk walk;
    for (Ticker& ticker : tickers) ticker.due(time);
    while (time.running()) {
        std::vector<Event> events = time.ends();
        for (const Ticker& ticker : tickers) events.push_back(ticker.next(time));
        const double dt = time.shorten(events);
        walk.shortest = std::min(walk.shortest, dt), walk.longest = std::max(walk.longest, dt);
        time.advance(dt);
        for (Ticker& ticker : tickers) ticker.due(time);
        walk.ends.push_back(time.strain());
        if (walk.ends.size() > 100000) break;
    }
    return walk;
}

TEST(StepEvents, AreHitToTheBit) {
    for (const double rate : {1.0, 3.0, 1082.5})
        for (const double step : {0.05, 0.0443, 0.07, 0.3, 1e-4 / 3}) {
            const Time time{.dt = step / rate, .shearRate = rate, .endStrain = 0.7};
            const Walk made = walk(time, {{Interval::Kind::strain, 0.1}, {Interval::Kind::strain, 0.25}});
            for (const double at : {0.1, 0.25, 2 * 0.1, 3 * 0.1, 2 * 0.25, 6 * 0.1, 0.7})
                EXPECT_NE(std::find(made.ends.begin(), made.ends.end(), at), made.ends.end())
                    << rate << ' ' << step << ' ' << at;
            EXPECT_EQ(made.ends.back(), 0.7);
            EXPECT_LE(made.longest, time.dt * 1.001);
        }
}

TEST(StepEvents, LeaveNoTinySteps) {
    // If one step and a rounding error are left: one step, not one and a tiny one; if somewhat more than one step is
    // left: two equal ones.
    const Time third{.dt = 0.1 / 3, .shearRate = 1, .endStrain = 0.7};
    const Walk made = walk(third, {{Interval::Kind::strain, 0.1}});
    EXPECT_EQ(made.ends.size(), 21U);
    EXPECT_GT(made.shortest, 0.999 * third.dt);
    const Walk halves = walk(Time{.dt = 0.08, .shearRate = 1, .endStrain = 0.5}, {{Interval::Kind::strain, 0.1}});
    EXPECT_EQ(halves.ends.size(), 10U);
    EXPECT_NEAR(halves.shortest, 0.05, 1e-12);
    EXPECT_NEAR(halves.longest, 0.05, 1e-12);
    // Two events less than a thousandth of a step apart count as one.
    const Walk near = walk(Time{.dt = 0.1, .shearRate = 1, .endStrain = 0.40001}, {{Interval::Kind::strain, 0.4}});
    EXPECT_EQ(near.ends.size(), 4U);
    EXPECT_EQ(near.ends.back(), 0.40001);
}

TEST(StepEvents, CostNothingWhereStepsFit) {
    const Walk made = walk(Time{.dt = 0.05 / 7, .shearRate = 7, .endStrain = 6},
                           {{Interval::Kind::strain, 0.1}, {Interval::Kind::strain, 0.5}});
    EXPECT_EQ(made.ends.size(), 120U);
}

TEST(StepEvents, InTime) {
    Time time{.dt = 0.3, .endTime = 1.0};
    std::vector<double> ends;
    while (time.running()) {
        time.advance(time.shorten({time.atTime(0.5), time.ends().front()}));
        ends.push_back(time.t);
    }
    EXPECT_EQ(ends, (std::vector<double>{0.25, 0.5, 0.75, 1.0}));
    EXPECT_EQ(Ticker().next(time).wait, std::numeric_limits<double>::infinity());
    EXPECT_EQ(Ticker({Interval::Kind::steps, 3}, time).next(time).wait, std::numeric_limits<double>::infinity());
}

// If the shear rate changes, the strain accumulated so far stays as it is.
TEST(Strain, IsSummed) {
    Time time{.dt = 0.1, .shearRate = 10};
    for (int k = 0; k < 10; ++k) time.advance(0.1);
    EXPECT_NEAR(time.strain(), 10, 1e-12);
    time.shearRate = 1;
    EXPECT_NEAR(time.strain(), 10, 1e-12);
    Ticker ticker({Interval::Kind::strain, 2}, time);
    EXPECT_NEAR(ticker.next(time).wait, 2, 1e-9);
    time.endStrain = 10.5;
    EXPECT_NEAR(time.left(), 0.5, 1e-12);
    while (time.running()) time.advance(0.1);
    EXPECT_NEAR(time.t, 1.5, 1e-9);
}

}  // namespace
}  // namespace corpuscle
