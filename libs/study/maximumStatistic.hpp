// The greatest value of the range.
#pragma once
#include "study/statistic.hpp"

namespace corpuscle::study {

struct MaximumStatistic : Statistic {
    Estimate of(std::span<const double> along, std::span<const double> values) const override;
    std::string text() const override { return "maximum"; }
    static const Schema<MaximumStatistic>& schema();
};

}  // namespace corpuscle::study
