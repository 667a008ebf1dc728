// PLY: a header in text,
//     ply  format ascii|binary_little_endian|binary_big_endian 1.0  { element NAME COUNT  { property ... } }
//         end_header
// and the elements in the order of the header, each with its properties: numbers of eight types, or lists of numbers
// preceded by their length. The reader takes x, y, z of `vertex`, the list vertex_indices (or vertex_index) of `face`
// and, if there are no faces, that of `tristrips`, in which -1 ends a strip. Everything else is ignored.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "geometry/surfaceFile.hpp"
#include "io/textNumber.hpp"

namespace corpuscle::geometry {
namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t widthOf(Type type) {
    constexpr std::array<std::size_t, 8> widths{1, 1, 2, 2, 4, 4, 4, 8};
    return widths[static_cast<std::size_t>(type)];
}

struct Property {
    std::string name;
    Type type = Type::float32, countType = Type::uint8;
    bool isList = false;
};
struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;
};

class Ply {
  public:
    explicit Ply(std::string_view bytes) : bytes_(bytes), lines_(bytes) {}

    PolygonSoup read() {
        readHeader();
        for (const Element& e : elements_) {
            number_ = 0;
            for (std::size_t i = 0; i < e.count; ++i, ++number_) readOne(e);
        }
        if (ascii_ ? lines_.next() : at_ < bytes_.size())
            fault(fmt::format("there is more behind the elements that the header announces{}",
                              ascii_ ? "" : fmt::format(": {} bytes", bytes_.size() - at_)));
        if (soup_.polygons.empty()) cutStrips();
        checkCorners();
        return std::move(soup_);
    }

  private:
    [[noreturn]] void fault(const std::string& what) const {
        if (ascii_) lines_.fault(what);
        throw SurfaceFault(current_ ? fmt::format("{} {}: {}", current_->name, number_, what) : what);
    }

    Type typeNamed(std::string_view word) const {
        constexpr std::array<std::pair<const char*, const char*>, 8> names{{{"char", "int8"},
                                                                            {"uchar", "uint8"},
                                                                            {"short", "int16"},
                                                                            {"ushort", "uint16"},
                                                                            {"int", "int32"},
                                                                            {"uint", "uint32"},
                                                                            {"float", "float32"},
                                                                            {"double", "float64"}}};
        for (std::size_t i = 0; i < names.size(); ++i)
            if (word == names[i].first || word == names[i].second) return static_cast<Type>(i);
        lines_.fault(fmt::format("'{}' is no type of a property", word));
    }

    void readHeader() {
        if (!lines_.next() || lines_.words().size() != 1 || lines_.words().front() != "ply")
            lines_.fault("'ply' is expected at the beginning of a PLY file");
        bool hasFormat = false;
        while (true) {
            if (!lines_.next()) lines_.fault("the file ends before end_header: it is cut off");
            const auto& words = lines_.words();
            const std::string_view first = words.front();
            if (first == "end_header") break;
            if (first == "comment" || first == "obj_info") continue;
            if (first == "format" && words.size() >= 2) {
                readFormat(words[1]);
                hasFormat = true;
            } else if (first == "element" && words.size() == 3) {
                const int count = lines_.integer(words[2]);
                elements_.push_back({std::string(words[1]), static_cast<std::size_t>(std::max(count, 0)), {}});
                for (std::size_t i = 0; i + 1 < elements_.size(); ++i)
                    if (elements_[i].name == words[1])
                        lines_.fault(fmt::format("the element {} stands twice", words[1]));
                // Each takes at least one byte, in text its line end included.
                if (count < 0 || static_cast<std::size_t>(count) > bytes_.size())
                    lines_.fault(fmt::format("{} of the element {} are announced, and the file has {} bytes", count,
                                             words[1], bytes_.size()));
            } else if (first == "property" && !elements_.empty() && words.size() == 3) {
                elements_.back().properties.push_back({std::string(words[2]), typeNamed(words[1]), Type::uint8, false});
            } else if (first == "property" && !elements_.empty() && words.size() == 5 && words[1] == "list") {
                elements_.back().properties.push_back(
                    {std::string(words[4]), typeNamed(words[3]), typeNamed(words[2]), true});
            } else {
                lines_.fault(fmt::format("'{}' is no line of a PLY header", lines_.line().substr(0, 60)));
            }
        }
        if (!hasFormat) lines_.fault("the header names no format");
        at_ = lines_.position();
        checkElements();
    }

    void readFormat(std::string_view word) {
        ascii_ = word == "ascii";
        littleEndian_ = word == "binary_little_endian";
        if (!ascii_ && !littleEndian_ && word != "binary_big_endian")
            lines_.fault(fmt::format("the format '{}' is not ascii, binary_little_endian or binary_big_endian", word));
    }

    void checkElements() const {
        bool hasVertices = false;
        for (const Element& e : elements_) {
            if (e.count > 0 && e.properties.empty())
                lines_.fault(fmt::format("the element {} has no properties", e.name));
            if (e.name == "vertex") {
                hasVertices = true;
                for (const char* axis : {"x", "y", "z"})
                    if (std::none_of(e.properties.begin(), e.properties.end(),
                                     [&](const Property& p) { return p.name == axis && !p.isList; }))
                        lines_.fault(fmt::format("the element vertex has no property {}", axis));
            }
        }
        if (!hasVertices) lines_.fault("there is no element vertex");
    }

    // The next number, from text or from binary data.
    double value(Type type) {
        if (ascii_) {
            if (word_ >= lines_.words().size()) lines_.fault("the line has too few numbers");
            const std::string_view word = lines_.words()[word_++];
            const auto number = io::textToDouble(word);
            return number ? *number : lines_.number(word);
        }
        const std::size_t width = widthOf(type);
        if (at_ + width > bytes_.size()) fault("the file ends here: it is cut off");
        std::uint64_t bits = 0;
        for (std::size_t k = 0; k < width; ++k)
            bits = bits << 8 | static_cast<unsigned char>(bytes_[at_ + (littleEndian_ ? width - 1 - k : k)]);
        at_ += width;
        switch (type) {
            case Type::int8:
                return static_cast<std::int8_t>(bits);
            case Type::int16:
                return static_cast<std::int16_t>(bits);
            case Type::int32:
                return static_cast<std::int32_t>(bits);
            case Type::float32:
                return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
            case Type::float64:
                return std::bit_cast<double>(bits);
            default:
                return static_cast<double>(bits);
        }
    }

    int integer(Type type) {
        const double x = value(type);
        if (!(x >= -1 && x <= 2147483647.0) || x != std::floor(x))
            fault(fmt::format("{} is not a number of a point", x));
        return static_cast<int>(x);
    }

    void readOne(const Element& e) {
        current_ = &e;
        if (ascii_) {
            if (!lines_.next())
                lines_.fault(fmt::format("the file ends here, after {} of {} of the element {}: it is cut off", number_,
                                         e.count, e.name));
            word_ = 0;
        }
        const bool vertex = e.name == "vertex", face = e.name == "face" || e.name == "tristrips";
        Vec3 x = Vec3::Zero();
        for (const Property& p : e.properties) {
            if (p.isList) {
                const int count = integer(p.countType);
                const std::size_t most = ascii_ ? lines_.words().size() : bytes_.size() - at_;
                if (count < 0 || static_cast<std::size_t>(count) > most)
                    fault(fmt::format("a list of {} is announced, and there is not so much in the {}", count,
                                      ascii_ ? "line" : "file"));
                const bool corners = face && (p.name == "vertex_indices" || p.name == "vertex_index");
                std::vector<int> list;
                for (int k = 0; k < count; ++k)
                    if (corners)
                        list.push_back(integer(p.type));
                    else
                        value(p.type);
                if (corners) keep(e, std::move(list));
            } else {
                const double number = value(p.type);
                if (!vertex || p.name.size() != 1 || p.name[0] < 'x' || p.name[0] > 'z') continue;
                if (!std::isfinite(number)) fault("a coordinate is not a finite number");
                x[p.name[0] - 'x'] = number;
            }
        }
        if (ascii_ && word_ != lines_.words().size())
            lines_.fault(fmt::format("the line has {} numbers, the properties of the element {} take {}",
                                     lines_.words().size(), e.name, word_));
        if (vertex) soup_.points.push_back(x);
    }

    void keep(const Element& e, std::vector<int> list) {
        if (e.name == "tristrips") {
            strips_.insert(strips_.end(), list.begin(), list.end());
            strips_.push_back(-1);
            return;
        }
        if (list.size() < 3) fault(fmt::format("a face of {} corners; at least 3 are needed", list.size()));
        soup_.polygons.push_back(std::move(list));
    }

    void cutStrips() {
        std::size_t begin = 0;
        for (std::size_t k = 0; k < strips_.size(); ++k) {
            if (strips_[k] < 0) begin = k + 1;
            if (k < begin + 2) continue;
            const bool turned = (k - begin) % 2 == 1;
            soup_.polygons.push_back({strips_[k - (turned ? 1 : 2)], strips_[k - (turned ? 2 : 1)], strips_[k]});
        }
    }

    void checkCorners() const {
        const int n = static_cast<int>(soup_.points.size());
        int least = n, most = -1;
        std::size_t first = soup_.polygons.size();
        int named = 0;
        for (std::size_t f = 0; f < soup_.polygons.size(); ++f)
            for (const int p : soup_.polygons[f]) {
                least = std::min(least, p), most = std::max(most, p);
                if ((p < 0 || p >= n) && first == soup_.polygons.size()) first = f, named = p;
            }
        if (first == soup_.polygons.size()) return;
        if (least == 1 && most == n)
            throw SurfaceFault(fmt::format(
                "the faces count the {} points from 1 to {}; PLY counts from 0: subtract 1 from each", n, n));
        throw SurfaceFault(fmt::format("face {} names point {}, and there are {}, counted from 0: write the file again",
                                       first, named, n));
    }

    std::string_view bytes_;
    TextLines lines_;
    bool ascii_ = true, littleEndian_ = true;
    std::vector<Element> elements_;
    const Element* current_ = nullptr;
    std::size_t at_ = 0, word_ = 0, number_ = 0;
    std::vector<int> strips_;
    PolygonSoup soup_;
};

}  // namespace

PolygonSoup readPly(std::string_view bytes) { return Ply(bytes).read(); }

}  // namespace corpuscle::geometry
