// Period of an oscillation: the mean distance, in strain or time, between upward crossings of the mean.
//
// A crossing counts once the series has been below the mean by 5 % of its whole range, so that noise around the mean
// does not count. Crossings are located by linear interpolation. For n >= 2 periods the standard error is that of n
// independent periods.
#pragma once
#include "study/statistic.hpp"

namespace corpuscle::study {

struct PeriodStatistic : Statistic {
    bool isAlong() const override { return true; }
    Estimate of(std::span<const double> along, std::span<const double> values) const override;
    bool hasError() const override { return true; }
    std::string text() const override { return "period"; }
    static const Schema<PeriodStatistic>& schema();
};

}  // namespace corpuscle::study
