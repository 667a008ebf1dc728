// A curve in text: dots of Braille, two by four in a character, or asterisks where the terminal has no UTF-8.
#pragma once
#include <string>
#include <vector>

namespace corpuscle {

// Lines of at most `columns` characters, with the range of y at the left and that of x below. Points that are not
// finite are left out; empty where none is left.
std::vector<std::string> plotText(const std::vector<double>& x, const std::vector<double>& y, int columns, int lines,
                                  bool unicode);

}  // namespace corpuscle
