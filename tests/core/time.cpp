#include "core/time.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace corpuscle {
namespace {

Interval every(Interval::Kind kind, double value) { return {kind, value}; }

TEST(Time, endsAtEachOfItsConditions) {
    Time time;
    EXPECT_FALSE(time.running());  // no end condition
    time.endTime = 1.0;
    time.dt = 0.1;
    long steps = 0;
    for (; time.running(); time.advance(0.1)) ++steps;  // the sum of ten times 0.1 is less than 1 in double precision
    EXPECT_EQ(steps, 10);
    EXPECT_EQ(time.endReason(), "endTime 1 s");

    time = {.dt = 0.01, .shearRate = 50, .endStrain = 6};
    for (steps = 0; time.running(); time.advance(0.01)) ++steps;
    EXPECT_EQ(steps, 12);
    EXPECT_EQ(time.endReason(), "endStrain 6");
    EXPECT_NEAR(time.fraction(), 1.0, 1e-12);

    time = {.step = 40, .endTime = 100.0, .lastStep = 43};
    for (steps = 0; time.running(); time.advance(0.01)) ++steps;
    EXPECT_EQ(steps, 3);
    EXPECT_EQ(time.endReason(), "step 43");
}

TEST(Ticker, isDueOnTheFirstStepAtOrPastEachMultiple) {
    Time time{.dt = 0.1};
    Ticker ticker(every(Interval::Kind::time, 0.25), time);
    std::vector<long> due;
    for (; time.step <= 10; time.advance(0.1))
        if (ticker.due(time)) due.push_back(time.step);
    EXPECT_EQ(due, (std::vector<long>{0, 3, 5, 8, 10}));
}

TEST(Ticker, roundMultiplesDespiteRounding) {
    Time time{.dt = 0.1};
    Ticker ticker(every(Interval::Kind::time, 0.3), time);
    std::vector<long> due;
    for (; time.step <= 12; time.advance(0.1))
        if (ticker.due(time)) due.push_back(time.step);
    EXPECT_EQ(due, (std::vector<long>{0, 3, 6, 9, 12}));
}

TEST(Ticker, oneLongStepIsOneEvent) {
    Time time;
    Ticker ticker(every(Interval::Kind::time, 0.1), time);
    EXPECT_TRUE(ticker.due(time));
    time.advance(1);
    EXPECT_TRUE(ticker.due(time));
    EXPECT_FALSE(ticker.due(time));
}

// A run that is stopped anywhere and restarted does, in both parts together, what an uninterrupted run does.
TEST(Ticker, restartContinuesTheSeries) {
    for (const Interval& interval : {every(Interval::Kind::time, 0.25), every(Interval::Kind::strain, 0.7),
                                     every(Interval::Kind::steps, 4), every(Interval::Kind::time, 0.3)})
        for (long stop = 1; stop < 20; ++stop) {
            std::vector<long> whole, parts;
            Time time{.dt = 0.1, .shearRate = 2};
            Ticker one(interval, time);
            for (; time.step < 20; time.advance(0.1))
                if (one.due(time)) whole.push_back(time.step);

            time = {.dt = 0.1, .shearRate = 2};
            Ticker first(interval, time);
            while (true) {
                if (first.due(time)) parts.push_back(time.step);
                if (time.step == stop) break;
                time.advance(0.1);
            }
            Ticker second(interval, time);
            EXPECT_FALSE(second.due(time));
            for (time.advance(0.1); time.step < 20; time.advance(0.1))
                if (second.due(time)) parts.push_back(time.step);
            EXPECT_EQ(parts, whole) << "stopped at " << stop;
        }
}

TEST(Ticker, stepsAndNever) {
    Time time;
    Ticker steps(every(Interval::Kind::steps, 3), time), never(Interval{}, time);
    std::vector<long> due;
    for (; time.step < 8; time.advance(1e-9)) {
        if (steps.due(time)) due.push_back(time.step);
        EXPECT_FALSE(never.due(time));
    }
    EXPECT_EQ(due, (std::vector<long>{0, 3, 6}));
    EXPECT_TRUE(Ticker().never());
}

TEST(Ticker, strainNeedsAShearRate) {
    EXPECT_THROW(Ticker(every(Interval::Kind::strain, 0.1), Time{}), Failure);
    Time time{.dt = 0.0001, .shearRate = 100};
    Ticker ticker(every(Interval::Kind::strain, 0.1), time);
    EXPECT_TRUE(ticker.due(time));
    time.advance(0.0009);
    EXPECT_FALSE(ticker.due(time));
    time.advance(0.0001);
    EXPECT_TRUE(ticker.due(time));
}

}  // namespace
}  // namespace corpuscle
