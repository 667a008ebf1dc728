// The value of greatest magnitude, with its sign: for changes that may be positive or negative.
#pragma once
#include "study/statistic.hpp"

namespace corpuscle::study {

struct ExtremeStatistic : Statistic {
    Estimate of(std::span<const double> along, std::span<const double> values) const override;
    std::string text() const override { return "extreme"; }
    static const Schema<ExtremeStatistic>& schema();
};

}  // namespace corpuscle::study
