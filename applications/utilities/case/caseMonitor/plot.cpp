#include "plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace corpuscle {
namespace {

// The bit of each dot of a Braille character, by column and row (Unicode 2800).
constexpr unsigned brailleDot[2][4] = {{0x01, 0x02, 0x04, 0x40}, {0x08, 0x10, 0x20, 0x80}};

std::string utf8(unsigned code) {
    return {static_cast<char>(0xe0 | (code >> 12)), static_cast<char>(0x80 | ((code >> 6) & 0x3f)),
            static_cast<char>(0x80 | (code & 0x3f))};
}

struct Range {
    double low, high;
    int place(double value, int dots) const {
        const double share = high > low ? (value - low) / (high - low) : 0.5;
        return std::clamp(static_cast<int>(std::lround(share * (dots - 1))), 0, dots - 1);
    }
};

}  // namespace

std::vector<std::string> plotText(const std::vector<double>& x, const std::vector<double>& y, int columns, int lines,
                                  bool unicode) {
    std::vector<std::pair<double, double>> points;
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
        if (std::isfinite(x[i]) && std::isfinite(y[i])) points.emplace_back(x[i], y[i]);
    if (points.empty()) return {};
    const auto [left, right] = std::minmax_element(points.begin(), points.end());
    const auto [low, high] =
        std::minmax_element(points.begin(), points.end(), [](auto& a, auto& b) { return a.second < b.second; });
    const Range across{left->first, right->first}, up{low->second, high->second};
    const std::string top = fmt::format("{:.4g}", up.high), bottom = fmt::format("{:.4g}", up.low);
    const auto margin = std::max(top.size(), bottom.size());
    const int width = std::max(8, columns - static_cast<int>(margin) - 2), wide = unicode ? 2 : 1,
              tall = unicode ? 4 : 1;
    std::vector<std::vector<unsigned>> cells(static_cast<std::size_t>(lines),
                                             std::vector<unsigned>(static_cast<std::size_t>(width), 0));
    const auto set = [&](int column, int row) {  // column and row of a dot, counted from the top
        cells[static_cast<std::size_t>(row / tall)][static_cast<std::size_t>(column / wide)] |=
            unicode ? brailleDot[column % 2][row % 4] : 1U;
    };
    int lastColumn = -1, lastRow = 0;
    for (const auto& [at, value] : points) {
        const int column = across.place(at, width * wide), row = lines * tall - 1 - up.place(value, lines * tall);
        // A line of dots from the previous point.
        const int steps = lastColumn < 0 ? 0 : std::max(std::abs(column - lastColumn), std::abs(row - lastRow));
        for (int k = 1; k < steps; ++k)
            set(lastColumn + (column - lastColumn) * k / steps, lastRow + (row - lastRow) * k / steps);
        set(column, row);
        lastColumn = column, lastRow = row;
    }
    std::vector<std::string> text;
    for (int line = 0; line < lines; ++line) {
        std::string row = fmt::format("{:>{}} ", line == 0 ? top : line == lines - 1 ? bottom : "", margin);
        row += unicode ? utf8(0x2502) : "|";
        for (const unsigned cell : cells[static_cast<std::size_t>(line)])
            row += cell == 0 ? " " : unicode ? utf8(0x2800 + cell) : "*";
        text.push_back(row.substr(0, row.find_last_not_of(' ') + 1));
    }
    const std::string first = fmt::format("{:.4g}", across.low), last = fmt::format("{:.4g}", across.high);
    text.push_back(std::string(margin + 2, ' ') + first +
                   std::string(static_cast<std::size_t>(
                                   std::max(1, width - static_cast<int>(first.size()) - static_cast<int>(last.size()))),
                               ' ') +
                   last);
    return text;
}

}  // namespace corpuscle
