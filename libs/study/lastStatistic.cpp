#include "study/lastStatistic.hpp"

namespace corpuscle::study {

Estimate LastStatistic::of(std::span<const double> /*along*/, std::span<const double> values) const {
    return {.value = values.back()};
}

const Schema<LastStatistic>& LastStatistic::schema() {
    static const Schema<LastStatistic> s = Schema<LastStatistic>("last", "the last value");
    return s;
}

CORPUSCLE_REGISTER(Statistic, LastStatistic, "last", "the last value");

}  // namespace corpuscle::study
