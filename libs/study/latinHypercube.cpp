#include "study/latinHypercube.hpp"

#include <numeric>

#include "core/random.hpp"

namespace corpuscle::study {

std::vector<std::vector<double>> LatinHypercube::points(const std::vector<std::size_t>& levels) const {
    const auto count = static_cast<std::size_t>(samples);
    std::vector<std::vector<double>> all(count, std::vector<double>(levels.size()));
    Random random(static_cast<std::uint64_t>(seed));
    for (std::size_t k = 0; k < levels.size(); ++k) {
        std::vector<std::size_t> part(count);
        std::iota(part.begin(), part.end(), std::size_t{0});
        for (std::size_t i = count; i > 1; --i)  // Fisher and Yates; std::shuffle differs between libraries
            std::swap(part[i - 1], part[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
        for (std::size_t i = 0; i < count; ++i)
            all[i][k] = (static_cast<double>(part[i]) + random.uniform()) / static_cast<double>(count);
    }
    return all;
}

const Schema<LatinHypercube>& LatinHypercube::schema() {
    static const Schema<LatinHypercube> s =
        Schema<LatinHypercube>("latinHypercube", "a number of cases spread over all ranges")
            .integer("samples", &LatinHypercube::samples, "number of cases", {.range = between(1, 100000)})
            .integer("seed", &LatinHypercube::seed, "of the random numbers", {.fallback = "1", .range = nonNegative});
    return s;
}

CORPUSCLE_REGISTER(Sampling, LatinHypercube, "latinHypercube",
                   "as many cases as wanted, spread evenly over the range of each parameter");

}  // namespace corpuscle::study
