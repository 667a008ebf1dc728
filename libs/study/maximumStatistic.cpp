#include "study/maximumStatistic.hpp"

#include <algorithm>

namespace corpuscle::study {

Estimate MaximumStatistic::of(std::span<const double> /*along*/, std::span<const double> values) const {
    return {.value = *std::max_element(values.begin(), values.end())};
}

const Schema<MaximumStatistic>& MaximumStatistic::schema() {
    static const Schema<MaximumStatistic> s = Schema<MaximumStatistic>("maximum", "the greatest value");
    return s;
}

CORPUSCLE_REGISTER(Statistic, MaximumStatistic, "maximum", "the greatest value");

}  // namespace corpuscle::study
