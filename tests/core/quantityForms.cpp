#include "core/quantityForms.hpp"

#include <gtest/gtest.h>

namespace corpuscle {
namespace {

bool takes(const std::string& text, Dimension dimension, const Range& range = anyValue) {
    return matches(plainUnits(text), quantityPattern(dimension, range));
}

TEST(QuantityForms, whatIsTakenIsOfTheDimensionAndUsualUnitsAre) {
    for (const Dimension d :
         {unit::metre, unit::second, unit::perSecond, unit::metrePerSecond, unit::metrePerSecond2,
          unit::kilogramPerMetre3, unit::pascal, unit::pascalSecond, unit::newton, unit::newtonPerMetre, unit::joule,
          unit::newtonSecondPerMetre, unit::metre2PerSecond, unit::metre.power(2), unit::metre.power(3),
          unit::metre.power(-1), Dimension{1, 2, -3}, Dimension{1, 0, 0}}) {
        EXPECT_TRUE(takes("0.1 " + d.si(), d)) << d.si();
        for (const std::string& u : usualUnits(d)) {
            EXPECT_TRUE(takes("0.1 " + u, d)) << u;
            EXPECT_EQ(parseQuantity("0.1 " + u).dimension, d) << u;
        }
    }
}

TEST(QuantityForms, otherDimensionsAndFormsAreNot) {
    EXPECT_FALSE(takes("8 Pa", unit::metre));
    EXPECT_FALSE(takes("8 m/s s", unit::metre));
    EXPECT_FALSE(takes("8", unit::metre));
    EXPECT_FALSE(takes("8 um\n", unit::metre));
    EXPECT_FALSE(takes("1 N/m s", unit::newtonSecondPerMetre));  // ambiguous: which units are in the denominator?
    EXPECT_FALSE(takes("81/s", unit::perSecond));                // ambiguous: 8 1/s or 81 /s?
    EXPECT_TRUE(takes("8 1/s", unit::perSecond));
    EXPECT_TRUE(takes("8s^-1", unit::perSecond));
    EXPECT_FALSE(takes("8 rad", unit::none));
    EXPECT_TRUE(takes("8", unit::none));
    EXPECT_FALSE(takes(std::string(300, '8') + " um", unit::metre));
}

TEST(QuantityForms, numbersAndTheirSigns) {
    for (const char* good : {"8", "+8", "8.", ".5", "1e-3", "1E+3", "0.001", "1e99"}) {
        EXPECT_TRUE(takes(good, unit::none)) << good;
        EXPECT_TRUE(takes(good, unit::none, positive)) << good;
        EXPECT_TRUE(takes(good, unit::none, nonNegative)) << good;
    }
    EXPECT_TRUE(takes("0.0", unit::none, nonNegative));
    EXPECT_TRUE(takes("-1", unit::none));
    EXPECT_FALSE(takes("-1", unit::none, nonNegative));
    EXPECT_FALSE(takes("0.0e5", unit::none, positive));
    for (const char* bad : {"1e100", "1e", "0x10", "nan", ".inf", "1,5", "", ".", "e5", "1 2"})
        EXPECT_FALSE(takes(bad, unit::none)) << bad;
    EXPECT_TRUE(matches("100 steps", intervalPattern()));
    EXPECT_TRUE(matches("5 min", intervalPattern()));
    EXPECT_FALSE(matches("1.5 steps", intervalPattern()));
    EXPECT_FALSE(matches("0 strain", intervalPattern()));
    EXPECT_TRUE(matches("3.0 dx", lengthPattern(positive)));
    EXPECT_TRUE(matches("1e3", integerPattern(atLeast(1))));
    EXPECT_FALSE(matches("0", integerPattern(atLeast(1))));
}

TEST(QuantityForms, theNearestUnitIsOfTheSameDimension) {
    EXPECT_EQ(nearestUnit("uM", unit::metre), "um");
    EXPECT_EQ(nearestUnit("micron", unit::metre), "um");
    EXPECT_EQ(nearestUnit("mPas", unit::pascalSecond), "mPa s");
    EXPECT_EQ(nearestUnit("cp", unit::pascalSecond), "cP");
    EXPECT_EQ(nearestUnit("kg/m3", unit::kilogramPerMetre3), "kg/m^3");
    EXPECT_EQ(nearestUnit("sec", unit::second), "s");
    EXPECT_EQ(nearestUnit("sec", unit::metre), "");
    EXPECT_EQ(nearestUnit("N/M", unit::newtonPerMetre), "N/m");
    EXPECT_EQ(unitOf("1.5e-3 mPas"), "mPas");
    EXPECT_EQ(unitOf("fast"), "fast");
}

}  // namespace
}  // namespace corpuscle
