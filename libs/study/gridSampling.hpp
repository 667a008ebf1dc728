// Every combination of the values of all parameters; the last parameter changes fastest.
#pragma once
#include "study/sampling.hpp"

namespace corpuscle::study {

struct GridSampling : Sampling {
    std::vector<std::vector<double>> points(const std::vector<std::size_t>& levels) const override;
    std::string refusal(const std::vector<std::string>& names, const std::vector<std::size_t>& levels) const override;
    bool namesByValues() const override { return true; }
    static const Schema<GridSampling>& schema();
};

}  // namespace corpuscle::study
