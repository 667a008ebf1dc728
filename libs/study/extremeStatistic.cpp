#include "study/extremeStatistic.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle::study {

Estimate ExtremeStatistic::of(std::span<const double> /*along*/, std::span<const double> values) const {
    return {.value = *std::max_element(values.begin(), values.end(),
                                       [](double a, double b) { return std::abs(a) < std::abs(b); })};
}

const Schema<ExtremeStatistic>& ExtremeStatistic::schema() {
    static const Schema<ExtremeStatistic> s = Schema<ExtremeStatistic>("extreme", "the value that is greatest in size");
    return s;
}

CORPUSCLE_REGISTER(Statistic, ExtremeStatistic, "extreme", "the value that is greatest in size");

}  // namespace corpuscle::study
