// OFF (Geomview): [ST][C][N]OFF, numbers of points, faces and (not used) edges, a line for each point, a line for each
// face: the number of its corners, their points, counted from 0, and optionally a colour. '#' begins a comment. After
// the three coordinates of a point follow three numbers of the normal (N), three or four of a colour (C), two of a
// texture (ST).
#include <fmt/format.h>

#include <algorithm>

#include "geometry/surfaceFile.hpp"

namespace corpuscle::geometry {
namespace {

class Off {
  public:
    explicit Off(std::string_view bytes) : bytes_(bytes), lines_(bytes, '#') {}

    PolygonSoup read() {
        if (!lines_.next()) throw SurfaceFault("the file is empty");
        readHeader();
        soup_.points.reserve(static_cast<std::size_t>(points_));
        for (int i = 0; i < points_; ++i) readPoint(i);
        soup_.polygons.reserve(static_cast<std::size_t>(faces_));
        int least = points_, most = -1;
        for (int i = 0; i < faces_; ++i) readFace(i, least, most);
        if (outside_ > 0) reportOutside(least, most);
        if (lines_.next())
            lines_.fault(fmt::format("there is more behind the {} points and {} faces that the header announces",
                                     points_, faces_));
        return std::move(soup_);
    }

  private:
    void readHeader() {
        std::vector<std::string_view> words = lines_.words();
        std::string kind(words.front());
        if (kind.size() >= 3 && equalsIgnoringCase(kind.substr(kind.size() - 3), "OFF")) {
            std::string_view prefix = std::string_view(kind).substr(0, kind.size() - 3);
            const auto has = [&](std::string_view word) {
                if (!prefix.starts_with(word)) return false;
                prefix.remove_prefix(word.size());
                return true;
            };
            const bool texture = has("ST"), colour = has("C"), normal = has("N");
            if (!prefix.empty())
                lines_.fault(fmt::format("'{}' is not read; OFF, COFF, NOFF, CNOFF and STOFF are", kind));
            least_ = 3u + (normal ? 3u : 0u) + (colour ? 3u : 0u) + (texture ? 2u : 0u);
            most_ = least_ + (colour ? 1u : 0u);
            words.erase(words.begin());
            if (!words.empty() && equalsIgnoringCase(words.front(), "BINARY"))
                lines_.fault("binary OFF is not read; save it as text");
            if (words.empty()) {
                if (!lines_.next()) lines_.fault("the file ends before the numbers of points and faces: it is cut off");
                words = lines_.words();
            }
        }
        if (words.size() < 2 || words.size() > 3)
            lines_.fault("an OFF file begins with 'OFF' and the numbers of points, faces and edges");
        points_ = count(words[0], "points");
        faces_ = count(words[1], "faces");
    }

    int count(std::string_view word, const char* what) const {
        const int n = lines_.integer(word);
        if (n < 0 || static_cast<std::size_t>(n) > bytes_.size() / 2)
            lines_.fault(fmt::format("{} {} are announced, and the file has {} bytes", n, what, bytes_.size()));
        return n;
    }

    void readPoint(int i) {
        if (!lines_.next())
            lines_.fault(fmt::format("the file ends here, after {} of {} points: it is cut off", i, points_));
        const auto& words = lines_.words();
        if (words.size() < least_ || words.size() > most_)
            lines_.fault(fmt::format("{} numbers stand where a point of {} is expected", words.size(), least_));
        Vec3 x;
        for (std::size_t k = 0; k < words.size(); ++k) {
            const double value = lines_.number(words[k]);
            if (k < 3) x[static_cast<long>(k)] = value;
        }
        soup_.points.push_back(x);
    }

    void readFace(int i, int& least, int& most) {
        if (!lines_.next())
            lines_.fault(fmt::format("the file ends here, after {} of {} faces: it is cut off", i, faces_));
        const auto& words = lines_.words();
        const int corners = lines_.integer(words.front());
        if (corners < 3) lines_.fault(fmt::format("a face of {} corners; at least 3 are needed", corners));
        if (words.size() < static_cast<std::size_t>(corners) + 1)
            lines_.fault(fmt::format("a face of {} corners with the numbers of {}", corners, words.size() - 1));
        std::vector<int> polygon;
        for (std::size_t k = 1; k <= static_cast<std::size_t>(corners); ++k) {
            const int p = lines_.integer(words[k]);
            least = std::min(least, p), most = std::max(most, p);
            if ((p < 0 || p >= points_) && outside_++ == 0)
                first_ = fmt::format("line {}: a face names point {}, and there are {}, counted from 0",
                                     lines_.number(), p, points_);
            polygon.push_back(p);
        }
        for (std::size_t k = static_cast<std::size_t>(corners) + 1; k < words.size(); ++k) lines_.number(words[k]);
        soup_.polygons.push_back(std::move(polygon));
    }

    [[noreturn]] void reportOutside(int least, int most) const {
        if (least == 1 && most == points_)
            throw SurfaceFault(
                fmt::format("the faces count the {} points from 1 to {}; OFF counts from 0: subtract 1 from each",
                            points_, points_));
        throw SurfaceFault(first_);
    }

    std::string_view bytes_;
    TextLines lines_;
    int points_ = 0, faces_ = 0;
    std::size_t least_ = 3, most_ = 3;  // how many numbers a point has
    int outside_ = 0;
    std::string first_;
    PolygonSoup soup_;
};

}  // namespace

PolygonSoup readOff(std::string_view bytes) { return Off(bytes).read(); }

}  // namespace corpuscle::geometry
