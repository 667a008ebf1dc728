#include "sph/localMean.hpp"

#include "sph/sidedRecords.hpp"

namespace corpuscle::sph {

std::vector<double> localMean(particles::ParticleSystem& system, const Kernel& kernel, double mass,
                              std::vector<double> values) {
    const particles::ParticleStore& s = system.store();
    const auto n = static_cast<std::size_t>(system.owned());
    particles::RealArray sums,
        records = sidedRecords(
            system, [&](std::size_t i) { return (s.optional().mass ? s.mass[i] : mass) / s.density[i]; },
            [&](std::size_t i) { return values[i]; });
    std::vector<double> means(n), unused(3 * n);
    double* const results[4] = {means.data(), unused.data(), unused.data() + n, unused.data() + 2 * n};
    const PairKernels::Mean mean = pairKernels().mean(kernel.kind(), system.precision());
    particles::sumOverPairs(system, mean, mean, {}, records, SidedRecord::fields, sums, results);
    for (std::size_t i = 0; i < n; ++i)
        if (s.kindOf(i) == particles::Kind::fluid) values[i] = means[i];
    return values;
}

}  // namespace corpuscle::sph
