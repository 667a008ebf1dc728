// The mean, with its standard error from block averages (core/blockAverage.hpp). Where no range is given, the second
// half of the run is used.
#pragma once
#include "study/statistic.hpp"

namespace corpuscle::study {

struct MeanStatistic : Statistic {
    Estimate of(std::span<const double> along, std::span<const double> values) const override;
    bool hasError() const override { return true; }
    bool needsEvenSpacing() const override { return true; }
    bool isOfWholeRun() const override { return false; }
    std::string text() const override { return "mean"; }
    static const Schema<MeanStatistic>& schema();
};

}  // namespace corpuscle::study
