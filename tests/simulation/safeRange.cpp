// The table of safe ranges: its format, and that the built-in table conforms to it.
#include "simulation/safeRange.hpp"

#include <gtest/gtest.h>

#include <set>

namespace corpuscle::simulation {
namespace {

const std::string header = "# a note\naxis,integrator,low,high,outside\n";

TEST(SafeRanges, AreReadWithCommasInTheLastColumn) {
    const std::vector<SafeRange> ranges = parseSafeRanges(
        header + "Ca,implicit,1e-3,10,the shape is off, by 3 %\n\nimplicit.step,implicit,0,0.05,\"it fails, late\"\n");
    ASSERT_EQ(ranges.size(), 2u);
    EXPECT_EQ(ranges[0].axis, "Ca");
    EXPECT_EQ(ranges[0].integrator, "implicit");
    EXPECT_EQ(ranges[0].low, 1e-3);
    EXPECT_EQ(ranges[0].high, 10);
    EXPECT_EQ(ranges[0].outside, "the shape is off, by 3 %");
    EXPECT_EQ(ranges[1].high, 0.05);
    EXPECT_EQ(ranges[1].outside, "it fails, late");
}

TEST(SafeRanges, AreRefusedWhereTheyAreNone) {
    for (const char* const line :
         {"Ca,implicit,1e-3,10", "Ca,implicit,1e-3,x,it fails", "Ca,implicit,2,1,it fails", "Ca,implicit,,1,it fails"})
        EXPECT_THROW(parseSafeRanges(header + line), std::invalid_argument) << line;
    EXPECT_THROW(parseSafeRanges("axis,low,high\n"), std::invalid_argument);
}

TEST(SafeRanges, BuiltInNameWhatACaseHas) {
    const std::set<std::string> axes{"Ca",
                                     "Re",
                                     "lambda",
                                     "stiffEdge",
                                     "implicit.step",
                                     "implicit.tolerance",
                                     "bulkModulus",
                                     "shifting.coefficient",
                                     "fill.jitter"},
        integrators{"implicit", "velocityVerlet"};
    EXPECT_FALSE(safeRanges().empty());
    for (const SafeRange& range : safeRanges()) {
        EXPECT_TRUE(axes.contains(range.axis)) << range.axis;
        EXPECT_TRUE(integrators.contains(range.integrator)) << range.integrator;
    }
}

}  // namespace
}  // namespace corpuscle::simulation
