// The least value of the range.
#pragma once
#include "study/statistic.hpp"

namespace corpuscle::study {

struct MinimumStatistic : Statistic {
    Estimate of(std::span<const double> along, std::span<const double> values) const override;
    std::string text() const override { return "minimum"; }
    static const Schema<MinimumStatistic>& schema();
};

}  // namespace corpuscle::study
