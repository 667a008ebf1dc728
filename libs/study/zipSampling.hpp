// The first values of all parameters make the first case, the second ones the second case, and so on.
#pragma once
#include "study/sampling.hpp"

namespace corpuscle::study {

struct ZipSampling : Sampling {
    std::vector<std::vector<double>> points(const std::vector<std::size_t>& levels) const override;
    std::string refusal(const std::vector<std::string>& names, const std::vector<std::size_t>& levels) const override;
    bool namesByValues() const override { return true; }
    static const Schema<ZipSampling>& schema();
};

}  // namespace corpuscle::study
