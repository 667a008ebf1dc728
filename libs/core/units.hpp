// Units at the border of the program: "8 um" -> 8e-6 m. Inside, every number is SI.
//
//   text      := number unit | number            (the second form only for dimensionless settings)
//   unit      := factor { ("*" | "." | " " | "/") factor }   e.g. "kg/m^3", "Pa s", "N/m", "m/s^2", "J"
//   factor    := [prefix] symbol ["^" integer]; the first may be "1" as in "1/s"
//   prefix    := a f p n u m c k M G  (u = micro)
//   symbols   := m s kg g N dyn Pa bar P (poise) J erg Hz W L l (litre) mmHg mmH2O cmH2O min h rad deg; prefixes on all
//                but kg, mmHg, mmH2O, cmH2O, min, h, rad, deg
//
// Angles are dimensionless ("rad" = 1, "deg" = pi/180). quantityForms.hpp defines which of these units a dictionary
// accepts for a dimension.
#pragma once
#include <string>

namespace corpuscle {

// Exponents of mass, length, time.
struct Dimension {
    int mass = 0, length = 0, time = 0;
    bool operator==(const Dimension&) const = default;
    Dimension operator*(const Dimension& o) const { return {mass + o.mass, length + o.length, time + o.time}; }
    Dimension operator/(const Dimension& o) const { return {mass - o.mass, length - o.length, time - o.time}; }
    Dimension power(int n) const { return {mass * n, length * n, time * n}; }
    bool isDimensionless() const { return *this == Dimension{}; }
    std::string si() const;  // "kg/m^3", "Pa s", "N/m", ... ; "" when dimensionless
};

namespace unit {
inline constexpr Dimension none{0, 0, 0};
inline constexpr Dimension metre{0, 1, 0};
inline constexpr Dimension second{0, 0, 1};
inline constexpr Dimension perSecond{0, 0, -1};
inline constexpr Dimension metrePerSecond{0, 1, -1};
inline constexpr Dimension metrePerSecond2{0, 1, -2};
inline constexpr Dimension kilogramPerMetre3{1, -3, 0};
inline constexpr Dimension pascal{1, -1, -2};
inline constexpr Dimension pascalSecond{1, -1, -1};
inline constexpr Dimension newton{1, 1, -2};
inline constexpr Dimension newtonPerMetre{1, 0, -2};
inline constexpr Dimension joule{1, 2, -2};
inline constexpr Dimension newtonSecondPerMetre{1, 0, -1};
inline constexpr Dimension metre2PerSecond{0, 2, -1};
inline constexpr Dimension metre3PerSecond{0, 3, -1};
}  // namespace unit

struct Quantity {
    double value = 0;         // SI
    Dimension dimension;      // of the unit that was written
    bool hasUnit = false;     // false: a bare number
    bool inSpacings = false;  // the unit was "dx": value counts particle spacings
};

// Parses "8 um", "1.2e-3 Pa s", "3.0 dx", "0.05". Throws std::invalid_argument with a message that says what is wrong
// and names the nearest known unit.
Quantity parseQuantity(const std::string& text);

// "8 um"-style text of an SI value for messages and tables: at most `digits` significant digits and a sensible prefix.
std::string formatQuantity(double si, Dimension dimension, int digits = 4);

}  // namespace corpuscle
