// Latin hypercube: the range of each parameter is cut into as many equal parts as there are cases. Each part is used by
// one case, at a random place within the part. McKay, Beckman, Conover 1979, Technometrics 21, 239.
#pragma once
#include "study/sampling.hpp"

namespace corpuscle::study {

struct LatinHypercube : Sampling {
    long samples = 0;
    long seed = 1;

    std::vector<std::vector<double>> points(const std::vector<std::size_t>& levels) const override;
    std::string refusal(const std::vector<std::string>&, const std::vector<std::size_t>&) const override { return {}; }
    bool namesByValues() const override { return false; }
    static const Schema<LatinHypercube>& schema();
};

}  // namespace corpuscle::study
