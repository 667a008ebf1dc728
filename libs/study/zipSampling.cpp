#include "study/zipSampling.hpp"

#include <fmt/format.h>

namespace corpuscle::study {

std::vector<std::vector<double>> ZipSampling::points(const std::vector<std::size_t>& levels) const {
    std::vector<std::vector<double>> all;
    const std::size_t count = levels.empty() ? 1 : levels.front();
    for (std::size_t level = 0; level < count; ++level) all.emplace_back(levels.size(), middle(level, count));
    return all;
}

std::string ZipSampling::refusal(const std::vector<std::string>& names, const std::vector<std::size_t>& levels) const {
    if (std::string refused = continuousRefusal(names, levels); !refused.empty()) return refused;
    for (std::size_t k = 1; k < levels.size(); ++k)
        if (levels[k] != levels[0])
            return fmt::format("'{}' has {} values and '{}' has {}; with zip all have the same number", names[0],
                               levels[0], names[k], levels[k]);
    return {};
}

const Schema<ZipSampling>& ZipSampling::schema() {
    static const Schema<ZipSampling> s = Schema<ZipSampling>("zip", "values of all parameters side by side");
    return s;
}

CORPUSCLE_REGISTER(Sampling, ZipSampling, "zip", "the first values of all parameters, then the second ones, ...");

}  // namespace corpuscle::study
