// STL, ASCII or binary. An ASCII file is
//     solid [name]  { facet normal n n n  outer loop  vertex x y z (3 times)  endloop  endfacet }  endsolid [name]
// words in any case, separated by blanks, tabs or line ends. A binary file has 80 bytes of any content, the number N of
// triangles (4 bytes), and 50 bytes for each: normal and three corners as 32-bit floats, 2 bytes of any content, all
// little-endian. It is recognised by its length, 84 + 50 N bytes, since its header may begin with "solid" too.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "geometry/surfaceFile.hpp"

namespace corpuscle::geometry {
namespace {

constexpr std::size_t headerBytes = 84, triangleBytes = 50;

template <class T>
T littleEndian(const char* bytes) {
    std::uint32_t bits = 0;
    for (int k = 3; k >= 0; --k) bits = bits << 8 | static_cast<unsigned char>(bytes[k]);
    return std::bit_cast<T>(bits);
}

class AsciiStl {
  public:
    explicit AsciiStl(std::string_view bytes) : lines_(bytes) {}

    PolygonSoup read() {
        if (!advance() || !is("solid")) lines_.fault("'solid' is expected at the beginning of an ASCII STL file");
        do {
            skipName();
            while (is("facet")) facet();
            if (ended_) cutOff();
            if (!is("endsolid"))
                lines_.fault(fmt::format("'{}' stands where 'facet' or 'endsolid' is expected", word()));
            at_ = lines_.words().size();  // the name
        } while (advance() && is("solid"));
        if (!ended_) lines_.fault(fmt::format("'{}' stands behind 'endsolid'", word()));
        return std::move(soup_);
    }

  private:
    std::string_view word() const { return lines_.words()[at_]; }
    bool is(std::string_view expected) const { return !ended_ && equalsIgnoringCase(word(), expected); }

    bool advance() {
        if (!ended_ && started_ && ++at_ < lines_.words().size()) return true;
        started_ = true;
        ended_ = !lines_.next();
        at_ = 0;
        return !ended_;
    }

    // The name ends with its line, or before "facet normal" if the whole file is one line.
    void skipName() {
        const int line = lines_.number();
        while (advance() && lines_.number() == line) {
            if (is("facet") && at_ + 1 < lines_.words().size() && equalsIgnoringCase(lines_.words()[at_ + 1], "normal"))
                return;
        }
    }

    [[noreturn]] void cutOff() const {
        lines_.fault(fmt::format("the file ends here, after {} whole triangles and without 'endsolid': it is cut off",
                                 soup_.polygons.size()));
    }
    void expect(std::string_view expected) {
        if (!advance()) cutOff();
        if (!is(expected)) lines_.fault(fmt::format("'{}' stands where '{}' is expected", word(), expected));
    }

    void facet() {
        expect("normal");
        for (int k = 0; k < 3; ++k)  // not used, and in some files not a number: the corners suffice
            if (!advance()) cutOff();
        expect("outer");
        expect("loop");
        std::vector<int> corners;
        for (int n = 0; n < 3; ++n) {
            expect("vertex");
            Vec3 x;
            for (int k = 0; k < 3; ++k) {
                if (!advance()) cutOff();
                x[k] = lines_.number(word());
            }
            corners.push_back(static_cast<int>(soup_.points.size()));
            soup_.points.push_back(x);
        }
        expect("endloop");
        expect("endfacet");
        soup_.polygons.push_back(std::move(corners));
        advance();
    }

    TextLines lines_;
    std::size_t at_ = 0;
    bool started_ = false, ended_ = false;
    PolygonSoup soup_;
};

PolygonSoup readBinary(std::string_view bytes, std::size_t triangles) {
    PolygonSoup soup;
    soup.points.reserve(3 * triangles);
    soup.polygons.reserve(triangles);
    for (std::size_t t = 0; t < triangles; ++t) {
        const char* record = bytes.data() + headerBytes + triangleBytes * t;
        std::vector<int> corners;
        for (int n = 0; n < 3; ++n) {
            Vec3 x;
            for (int k = 0; k < 3; ++k) x[k] = static_cast<double>(littleEndian<float>(record + 12 * (n + 1) + 4 * k));
            if (!x.allFinite()) throw SurfaceFault(fmt::format("triangle {}: a coordinate is not a finite number", t));
            corners.push_back(static_cast<int>(soup.points.size()));
            soup.points.push_back(x);
        }
        soup.polygons.push_back(std::move(corners));
    }
    return soup;
}

// Whether the file is text, by its first word and the absence of zero bytes near the beginning.
bool looksLikeText(std::string_view bytes) {
    const std::string_view begin = bytes.substr(0, 512);
    const std::size_t first = begin.starts_with("\xEF\xBB\xBF") ? 3 : begin.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && equalsIgnoringCase(begin.substr(first, 5), "solid") &&
           begin.find('\0') == std::string_view::npos;
}

}  // namespace

PolygonSoup readStl(std::string_view bytes) {
    if (bytes.size() >= headerBytes) {
        const std::uint64_t triangles = littleEndian<std::uint32_t>(bytes.data() + 80);
        if (headerBytes + triangleBytes * triangles == bytes.size()) return readBinary(bytes, triangles);
        if (!looksLikeText(bytes) && !bytes.starts_with("\xFF\xFE") && !bytes.starts_with("\xFE\xFF"))
            throw SurfaceFault(
                fmt::format("neither ASCII STL, which begins with 'solid', nor binary: its header announces {} "
                            "triangles, which take "
                            "{} bytes, and the file has {}: it is cut off, damaged or another format",
                            triangles, headerBytes + triangleBytes * triangles, bytes.size()));
    }
    return AsciiStl(bytes).read();
}

}  // namespace corpuscle::geometry
