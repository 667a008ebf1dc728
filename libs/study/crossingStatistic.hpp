// The first strain or time at which the series reaches a level, from either side, by linear interpolation.
#pragma once
#include "study/statistic.hpp"

namespace corpuscle::study {

struct CrossingStatistic : Statistic {
    double level = 0;  // in SI units, as in the table

    bool isAlong() const override { return true; }
    Estimate of(std::span<const double> along, std::span<const double> values) const override;
    std::string text() const override;
    static const Schema<CrossingStatistic>& schema();
};

}  // namespace corpuscle::study
