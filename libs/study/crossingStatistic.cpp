#include "study/crossingStatistic.hpp"

#include <fmt/format.h>

namespace corpuscle::study {

Estimate CrossingStatistic::of(std::span<const double> along, std::span<const double> values) const {
    if (values.front() == level) return {.value = along.front()};
    for (std::size_t k = 1; k < values.size(); ++k) {
        const double before = values[k - 1] - level, now = values[k] - level;
        if (before * now <= 0) return {.value = along[k - 1] + before / (before - now) * (along[k] - along[k - 1])};
    }
    return {};
}

std::string CrossingStatistic::text() const { return fmt::format("first crossing of {:g}", level); }

const Schema<CrossingStatistic>& CrossingStatistic::schema() {
    static const Schema<CrossingStatistic> s =
        Schema<CrossingStatistic>("crossing", "where the series first reaches a level")
            .quantity("level", &CrossingStatistic::level, unit::none, "in the unit of the table's column");
    return s;
}

CORPUSCLE_REGISTER(Statistic, CrossingStatistic, "crossing",
                   "the first strain or time at which the series reaches a level");

}  // namespace corpuscle::study
