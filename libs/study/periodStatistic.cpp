#include "study/periodStatistic.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace corpuscle::study {

Estimate PeriodStatistic::of(std::span<const double> along, std::span<const double> values) const {
    constexpr double clear = 0.05;  // of the range: how far the series must be below the mean before a crossing counts
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    const double low = mean - clear * (*greatest - *least);
    std::vector<double> crossings;
    bool wasBelow = false;
    for (std::size_t k = 1; k < values.size(); ++k) {
        wasBelow = wasBelow || values[k - 1] < low;
        if (!wasBelow || values[k - 1] >= mean || values[k] < mean) continue;
        const double part = (mean - values[k - 1]) / (values[k] - values[k - 1]);
        crossings.push_back(along[k - 1] + part * (along[k] - along[k - 1]));
        wasBelow = false;
    }
    Estimate period;
    if (crossings.size() < 2) return period;
    const auto count = static_cast<double>(crossings.size() - 1);
    period.value = (crossings.back() - crossings.front()) / count;
    period.isReliable = crossings.size() > 2;
    if (!period.isReliable) return period;
    double square = 0;
    for (std::size_t k = 1; k < crossings.size(); ++k)
        square += std::pow(crossings[k] - crossings[k - 1] - period.value, 2);
    period.error = std::sqrt(square / (count * (count - 1)));
    return period;
}

const Schema<PeriodStatistic>& PeriodStatistic::schema() {
    static const Schema<PeriodStatistic> s = Schema<PeriodStatistic>("period", "the period of an oscillation");
    return s;
}

CORPUSCLE_REGISTER(Statistic, PeriodStatistic, "period",
                   "mean distance between the places where the series goes up through its mean");

}  // namespace corpuscle::study
