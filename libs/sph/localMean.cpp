#include "sph/localMean.hpp"

#include <cmath>

#include "particles/sumOverPairs.hpp"

namespace corpuscle::sph {

std::vector<double> localMean(particles::ParticleSystem& system, const Kernel& kernel, double mass,
                              std::vector<double> values) {
    constexpr std::size_t fields = 6;
    constexpr double noSide = -1;
    const particles::ParticleStore& s = system.store();
    const auto n = static_cast<std::size_t>(system.owned());
    const auto isFluid = [&](std::size_t i) { return s.kindOf(i) == particles::Kind::fluid; };
    particles::RealArray records((n + static_cast<std::size_t>(system.ghosts())) * fields), sums;
    const particles::RecordFrame frame(system);
    const double unitVolume = std::pow(system.spacing(), -3);
    for (std::size_t i = 0; i < n; ++i) {
        double* r = records.data() + fields * i;
        frame.position(i, r);
        if (system.periodicity().slides()) {  // particles may have been wrapped since the lists were built
            const Vec3 x = s.position(i), built(s.xBuilt[i], s.yBuilt[i], s.zBuilt[i]);
            Vec3::Map(r) += (system.periodicity().nearest(x, built) - x) / system.support();
        }
        r[3] = (s.optional().mass ? s.mass[i] : mass) / s.density[i] * unitVolume;
        r[4] = values[i];
        r[5] = !isFluid(i) ? noSide : s.optional().side ? static_cast<double>(s.side[i]) : 0;
    }
    std::vector<double> means(n), unused(3 * n);
    double* const results[4] = {means.data(), unused.data(), unused.data() + n, unused.data() + 2 * n};
    const PairKernels::Mean mean = pairKernels().mean(kernel.kind(), system.precision());
    particles::sumOverPairs(system, mean, mean, {}, records, static_cast<int>(fields), sums, results);
    for (std::size_t i = 0; i < n; ++i)
        if (isFluid(i)) values[i] = means[i];
    return values;
}

}  // namespace corpuscle::sph
