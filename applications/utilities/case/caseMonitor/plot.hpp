// A curve drawn as text: in Braille characters of two by four dots each, or in asterisks where the terminal has no
// UTF-8.
#pragma once
#include <string>
#include <vector>

namespace corpuscle {

// Lines of at most `columns` characters, with the range of y to the left of the curve and that of x below it. Points
// that are not finite are left out; the result is empty if no point remains.
std::vector<std::string> plotText(const std::vector<double>& x, const std::vector<double>& y, int columns, int lines,
                                  bool unicode);

}  // namespace corpuscle
