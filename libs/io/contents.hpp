// The list of what a checkpoint holds: number of ranks, attributes with their values, datasets with type, shape and
// checksum. The list has its own checksum in the file, so that nothing can be lost, renamed or changed unnoticed.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

#include "io/checksum.hpp"

namespace corpuscle::io {

class Contents {
  public:
    void ranks(std::int64_t count) { add(fmt::format("ranks {}", count)); }
    void attribute(const std::string& name, double value) {
        add(fmt::format("attribute {} double {:x}", name, std::bit_cast<std::uint64_t>(value)));
    }
    void attribute(const std::string& name, std::int64_t value) {
        add(fmt::format("attribute {} int {}", name, value));
    }
    void attribute(const std::string& name, const std::string& text) {
        add(fmt::format("attribute {} text {}", name, text));
    }
    // fullName includes the group: "data/fluid/velocity".
    void dataset(const std::string& fullName, bool isDouble, std::uint64_t rows, std::uint64_t components,
                 std::uint64_t sum) {
        add(fmt::format("dataset {} {} {} {} {:x}", fullName, isDouble, rows, components, sum));
    }

    std::uint64_t sum() const {
        std::vector<std::string> sorted = lines_;
        std::sort(sorted.begin(), sorted.end());
        std::string all;
        for (const std::string& line : sorted) all += line + '\n';
        return checksum(all);
    }

  private:
    void add(std::string line) { lines_.push_back(std::move(line)); }
    std::vector<std::string> lines_;
};

}  // namespace corpuscle::io
