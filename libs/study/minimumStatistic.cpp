#include "study/minimumStatistic.hpp"

#include <algorithm>

namespace corpuscle::study {

Estimate MinimumStatistic::of(std::span<const double> /*along*/, std::span<const double> values) const {
    return {.value = *std::min_element(values.begin(), values.end())};
}

const Schema<MinimumStatistic>& MinimumStatistic::schema() {
    static const Schema<MinimumStatistic> s = Schema<MinimumStatistic>("minimum", "the least value");
    return s;
}

CORPUSCLE_REGISTER(Statistic, MinimumStatistic, "minimum", "the least value");

}  // namespace corpuscle::study
