#include "io/dataChecksum.hpp"

#include <fmt/format.h>

#include "io/checksum.hpp"

namespace corpuscle::io {
namespace {

class Digest {
  public:
    template <class T>
    void add(const std::string& name, std::span<const T> values) {
        state_ = mix(state_ + checksum(name));
        state_ = mix(state_ + checksum(values, 0)) + values.size();
    }
    void add(const std::string& name, const std::string& text) {
        state_ = mix(state_ + checksum(name));
        state_ = mix(state_ + checksum(text)) + text.size();
    }
    void add(const std::string& name, const std::vector<Vec3>& values) {
        add(name, std::span<const double>(values.empty() ? nullptr : values[0].data(), 3 * values.size()));
    }
    std::string text() const { return fmt::format("{:016x}", state_); }

  private:
    std::uint64_t state_ = 0;
};

void addArrays(Digest& digest, const std::string& of, const Arrays& arrays) {
    for (const auto& [name, values] : arrays.scalars)
        digest.add(fmt::format("{} scalar {}", of, name), std::span<const double>(values));
    for (const auto& [name, values] : arrays.vectors) digest.add(fmt::format("{} vector {}", of, name), values);
    for (const auto& [name, values] : arrays.integers)
        digest.add(fmt::format("{} integer {}", of, name), std::span<const std::int64_t>(values));
    for (const auto& [name, words] : arrays.others) digest.add(fmt::format("{} {}", of, name), words);
}

}  // namespace

std::string dataChecksum(const PolyData& data) { return dataChecksum(data, data.field); }

std::string dataChecksum(const PolyData& data, const std::map<std::string, double>& field) {
    Digest digest;
    digest.add("points", data.points);
    std::vector<std::int64_t> corners;
    for (const Index3& t : data.triangles) corners.insert(corners.end(), t.begin(), t.end());
    digest.add("triangles", std::span<const std::int64_t>(corners));
    corners.clear();
    for (const std::vector<int>& line : data.lines) {
        corners.push_back(static_cast<std::int64_t>(line.size()));
        corners.insert(corners.end(), line.begin(), line.end());
    }
    digest.add("lines", std::span<const std::int64_t>(corners));
    addArrays(digest, "point", data.point);
    addArrays(digest, "cell", data.cell);
    for (const auto& [name, value] : field) digest.add("field " + name, std::span<const double>(&value, 1));
    for (const auto& [name, text] : data.texts)
        if (name != checksumText) digest.add("text " + name, text);
    return digest.text();
}

}  // namespace corpuscle::io
