// The last value of the range.
#pragma once
#include "study/statistic.hpp"

namespace corpuscle::study {

struct LastStatistic : Statistic {
    Estimate of(std::span<const double> along, std::span<const double> values) const override;
    std::string text() const override { return "last"; }
    static const Schema<LastStatistic>& schema();
};

}  // namespace corpuscle::study
