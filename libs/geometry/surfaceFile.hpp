// Common parts of the readers of surface files: points and polygons exactly as a file contains them, and iteration over
// the lines and words of a text file.
//
// A reader takes the whole file as bytes and throws SurfaceFault for any error, with its place: "line 12: ...". Before
// memory is allocated, the numbers that a file announces are compared with the bytes that it has.
#pragma once
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/vec.hpp"

namespace corpuscle::geometry {

struct PolygonSoup {
    std::vector<Vec3> points;
    std::vector<std::vector<int>> polygons;  // at least three corners each, all within the points
};

struct SurfaceFault : std::runtime_error {
    explicit SurfaceFault(const std::string& text) : std::runtime_error(printable(text)) {}
};

PolygonSoup readStl(std::string_view bytes);
PolygonSoup readOff(std::string_view bytes);
PolygonSoup readPly(std::string_view bytes);
PolygonSoup readVtpSurface(std::string_view bytes);

// Lines of a text that end with \n, \r\n or \r, and their words.
class TextLines {
  public:
    // Comments begin with `comment` and go to the end of the line; 0: there are none. Throws SurfaceFault for UTF-16.
    explicit TextLines(std::string_view text, char comment = 0);

    // The next line that has words; false at the end.
    bool next();
    const std::vector<std::string_view>& words() const { return words_; }
    std::string_view line() const { return line_; }
    int number() const { return number_; }        // of this line, from 1
    std::size_t position() const { return at_; }  // of the first byte after this line

    [[noreturn]] void fault(const std::string& what) const;  // "line 12: what"
    double number(std::string_view word) const;              // the word as a finite number, or a fault
    int integer(std::string_view word) const;

  private:
    std::string_view text_, line_;
    char comment_;
    std::size_t at_ = 0;
    int number_ = 0;
    std::vector<std::string_view> words_;
};

bool equalsIgnoringCase(std::string_view a, std::string_view b);

}  // namespace corpuscle::geometry
