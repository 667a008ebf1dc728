#include "study/sampling.hpp"

#include <fmt/format.h>

namespace corpuscle::study {

std::string Sampling::continuousRefusal(const std::vector<std::string>& names, const std::vector<std::size_t>& levels) {
    for (std::size_t k = 0; k < levels.size(); ++k)
        if (levels[k] == 0)
            return fmt::format("'{}' has a range and no 'count' of values in it; give one, or take latinHypercube",
                               names[k]);
    return {};
}

}  // namespace corpuscle::study
