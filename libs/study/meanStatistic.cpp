#include "study/meanStatistic.hpp"

#include <cmath>

#include "core/blockAverage.hpp"

namespace corpuscle::study {

Estimate MeanStatistic::of(std::span<const double> /*along*/, std::span<const double> values) const {
    constexpr double rounding = 1e-9;  // relative to the mean: values that differ by less count as equal
    const BlockAverage average = blockAverage(values);
    return {.value = average.mean,
            .error = average.error,
            .isReliable = average.isReliable || average.error <= rounding * std::abs(average.mean)};
}

const Schema<MeanStatistic>& MeanStatistic::schema() {
    static const Schema<MeanStatistic> s = Schema<MeanStatistic>("mean", "the mean, with its standard error");
    return s;
}

CORPUSCLE_REGISTER(Statistic, MeanStatistic, "mean",
                   "the mean, with its standard error; of the second half of the run unless 'from' is given");

}  // namespace corpuscle::study
