#include "study/gridSampling.hpp"

namespace corpuscle::study {

std::vector<std::vector<double>> GridSampling::points(const std::vector<std::size_t>& levels) const {
    std::vector<std::vector<double>> all{{}};
    for (const std::size_t count : levels) {
        std::vector<std::vector<double>> longer;
        for (const auto& point : all)
            for (std::size_t level = 0; level < count; ++level) {
                longer.push_back(point);
                longer.back().push_back(middle(level, count));
            }
        all = std::move(longer);
    }
    return all;
}

std::string GridSampling::refusal(const std::vector<std::string>& names, const std::vector<std::size_t>& levels) const {
    return continuousRefusal(names, levels);
}

const Schema<GridSampling>& GridSampling::schema() {
    static const Schema<GridSampling> s = Schema<GridSampling>("grid", "every combination of values");
    return s;
}

CORPUSCLE_REGISTER(Sampling, GridSampling, "grid", "every combination of the values of all parameters");

}  // namespace corpuscle::study
