#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/units.hpp"

namespace corpuscle {
namespace {

void expectQuantity(const std::string& text, double value, Dimension dimension) {
    const Quantity q = parseQuantity(text);
    EXPECT_EQ(q.value, value) << text;
    EXPECT_EQ(q.dimension, dimension) << text;
}

// For units whose factor is not a power of ten.
void expectNearly(const std::string& text, double value, Dimension dimension) {
    const Quantity q = parseQuantity(text);
    EXPECT_DOUBLE_EQ(q.value, value) << text;
    EXPECT_EQ(q.dimension, dimension) << text;
}

std::string complaint(const std::string& text) {
    try {
        parseQuantity(text);
    } catch (const std::invalid_argument& e) {
        return e.what();
    }
    return "";
}

TEST(Units, prefixesGiveTheDoubleThatIsWritten) {
    expectQuantity("8 um", 8e-6, unit::metre);
    expectQuantity("2.12 um", 2.12e-6, unit::metre);
    expectQuantity("1.2e-3 Pa s", 1.2e-3, unit::pascalSecond);
    expectQuantity("1.2 mPa s", 1.2e-3, unit::pascalSecond);
    expectQuantity("5e-4 N/m", 5e-4, unit::newtonPerMetre);
    expectQuantity("5.5 uN/m", 5.5e-6, unit::newtonPerMetre);
    expectQuantity("1000 kg/m^3", 1000, unit::kilogramPerMetre3);
    expectQuantity("1.0 g/cm^3", 1000, unit::kilogramPerMetre3);
    expectQuantity("90 fL", 90e-18, {0, 3, 0});
    expectQuantity("90 um^3", 90e-18, {0, 3, 0});
    expectQuantity("+3 kPa", 3000, unit::pascal);
    expectQuantity("8 \xC2\xB5m", 8e-6, unit::metre);
    expectQuantity("8um", 8e-6, unit::metre);
}

TEST(Units, timesAnglesAndCompounds) {
    expectQuantity("5 min", 300, unit::second);
    expectQuantity("2 h", 7200, unit::second);
    expectQuantity("100 1/s", 100, unit::perSecond);
    expectQuantity("100 s^-1", 100, unit::perSecond);
    expectQuantity("100 Hz", 100, unit::perSecond);
    expectQuantity("180 deg", std::numbers::pi, unit::none);
    expectQuantity("1 N*s/m", 1, unit::newtonSecondPerMetre);
    expectQuantity("1 cP", 1e-3, unit::pascalSecond);
    expectQuantity("2 P", 0.2, unit::pascalSecond);
    expectQuantity("1.2 mPa.s", 1.2e-3, unit::pascalSecond);
    expectQuantity("1.2 mPa*s", 1.2e-3, unit::pascalSecond);
    expectQuantity("5 dyn/cm", 5e-3, unit::newtonPerMetre);
    expectQuantity("3 dyn", 3e-5, unit::newton);
    expectQuantity("2 bar", 2e5, unit::pascal);
    expectNearly("1 mmHg", 133.322387415, unit::pascal);
    expectNearly("10 cmH2O", 980.665, unit::pascal);
    expectNearly("10 mmH2O/s", 98.0665, unit::pascal * unit::perSecond);
    expectQuantity("7 erg", 7e-7, unit::joule);
    expectQuantity("0.3 aJ", 0.3e-18, unit::joule);
    expectQuantity("90 fl", 90e-18, {0, 3, 0});
    expectQuantity("1000 kg/m\xC2\xB3", 1000, unit::kilogramPerMetre3);
    expectQuantity("9 m\xC2\xB7s\xE2\x81\xBB\xC2\xB2", 9, unit::metrePerSecond2);
    expectQuantity("3 mm", 3e-3, unit::metre);
    expectQuantity("9.81 m/s^2", 9.81, unit::metrePerSecond2);
}

TEST(Units, bareNumbersAndSpacings) {
    EXPECT_FALSE(parseQuantity("0.05").hasUnit);
    EXPECT_FALSE(parseQuantity("-1.5e3").hasUnit);
    EXPECT_EQ(parseQuantity("012").value, 12);
    const Quantity spacings = parseQuantity("3.0 dx");
    EXPECT_TRUE(spacings.inSpacings);
    EXPECT_EQ(spacings.value, 3.0);
}

TEST(Units, faultsSayWhatIsNear) {
    EXPECT_NE(complaint("8 Um").find("Did you mean 'um'?"), std::string::npos) << complaint("8 Um");
    EXPECT_NE(complaint("8 parsec").find("unknown unit 'parsec'"), std::string::npos);
    for (const char* const known : {" m ", " erg ", " W ", " L ", " kg ", " mmHg ", " cmH2O ", " deg "})
        EXPECT_NE(complaint("8 parsec").find(known), std::string::npos) << known;
    EXPECT_NE(complaint("fast").find("does not start with a number"), std::string::npos);
    EXPECT_NE(complaint("1e999 m").find("double precision"), std::string::npos);
    for (const char* wrong :
         {"", "8 um um2", "1 m^", "1 m^x", "1 m/", "nan", "inf m", "0x10 m", "1 kkg", "1 1/", "3 m 4"})
        EXPECT_NE(complaint(wrong), "") << wrong;
}

TEST(Units, namesOfDimensionsCanBeReadAgain) {
    for (int mass = -2; mass <= 2; ++mass)
        for (int length = -3; length <= 3; ++length)
            for (int time = -3; time <= 2; ++time) {
                const Dimension d{mass, length, time};
                if (d.isDimensionless()) continue;
                EXPECT_EQ(parseQuantity("1 " + d.si()).dimension, d) << d.si();
                EXPECT_EQ(parseQuantity("0.1 " + d.si()).value, 0.1) << d.si();
            }
    EXPECT_EQ(unit::pascalSecond.si(), "Pa s");
    EXPECT_EQ(unit::newtonPerMetre.si(), "N/m");
}

TEST(Units, formattedForReaders) {
    EXPECT_EQ(formatQuantity(8e-6, unit::metre), "8 um");
    EXPECT_EQ(formatQuantity(1.23456e-3, unit::pascalSecond), "1.235 mPa s");
    EXPECT_EQ(formatQuantity(-5e-4, unit::newtonPerMetre), "-500 uN/m");
    EXPECT_EQ(formatQuantity(1000, unit::kilogramPerMetre3), "1000 kg/m^3");
    EXPECT_EQ(formatQuantity(0, unit::metre), "0 m");
    EXPECT_EQ(formatQuantity(140e-12, {0, 2, 0}), "140 um^2");
    EXPECT_EQ(formatQuantity(9.99999e-7, unit::second), "1 us");
    EXPECT_EQ(formatQuantity(2.5e6, unit::pascal), "2.5 MPa");
    EXPECT_EQ(formatQuantity(0.02, unit::none), "0.02");
    for (double v : {3.7e-6, 1.1, 250.0, 4e-19})
        for (Dimension d : {unit::metre, unit::joule, unit::newtonPerMetre, unit::perSecond}) {
            const Quantity back = parseQuantity(formatQuantity(v, d, 12));
            EXPECT_NEAR(back.value / v, 1, 1e-10);
            EXPECT_EQ(back.dimension, d);
        }
}

}  // namespace
}  // namespace corpuscle
