// How a quantity may be written: for each dimension, the units that a dictionary accepts, as a regular expression.
// Reader and JSON schema both use it, so that they accept the same texts.
//
// A dimension has a few forms, each a product of kinds of units: a viscosity is pressure x time, poise, force x time /
// length^2 or mass / length / time. A kind stands for its symbols with prefixes (units.hpp). Numerators come first,
// joined by a blank, '*' or '.'; denominators follow, each as "/m^2" or " m^-2". parseQuantity (units.hpp) reads more
// than that: to it "8 Pa m/Pa" is a length, but nobody writes a length like that.
#pragma once
#include <string>
#include <vector>

#include "core/settings.hpp"

namespace corpuscle {

// The magnitude of a number lies between these, or is zero.
inline constexpr double leastNumber = 1e-100, largestNumber = 1e100;
inline constexpr double largestInteger = 9e15;

// Pattern (ECMA 262, without ^ and $) that a scalar must match as a whole; the reader applies `plainUnits` first. The
// value of a bare number is checked against the range as well; for a quantity with a unit, the pattern checks the sign.
std::string quantityPattern(Dimension dimension, const Range& range);
std::string lengthPattern(const Range& range);  // in metres or in "dx"
std::string intervalPattern();
std::string integerPattern(const Range& range);
extern const char* const namePattern;
extern const char* const reservedWords;  // pattern of words that YAML takes for true, false or nothing

// The same pattern for the JSON schema, which also allows the micro sign, raised digits and the middle dot.
std::string withUnicode(std::string pattern);
// The text with these signs replaced by plain ones: "8 µm" becomes "8 um", "kg/m³" becomes "kg/m^3".
std::string plainUnits(std::string text);
// Whether the whole text matches; patterns are compiled once. A text of more than 200 bytes never matches.
bool matches(const std::string& text, const std::string& pattern);

// Units that people write, the usual one first: "um", "nm", ...
std::vector<std::string> usualUnits(Dimension dimension);
// The unit of this dimension that is nearest to the text, or "".
std::string nearestUnit(const std::string& unit, Dimension dimension);
// "1.5 ums" -> "ums"; the whole text where it starts with no number.
std::string unitOf(const std::string& quantity);

}  // namespace corpuscle
