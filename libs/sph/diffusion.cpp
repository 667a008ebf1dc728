#include "sph/diffusion.hpp"

#include <cmath>

#include "sph/sidedRecords.hpp"

namespace corpuscle::sph {

// The factor of the sums of DiffusionPair, whose volumes are in units of dx^3.
Diffusion::Diffusion(const FluidModel& model, const particles::ParticleSystem& system)
    : kernel_(model.kernel->kind()),
      mass_(model.mass),
      density_(model.density),
      factor_(2 * model.solute->diffusivity / model.kernel->secondMoment(system.support() / system.spacing()) *
              model.kernel->gradientNormalisation(system.support()) * std::pow(system.spacing(), 6)) {}

void Diffusion::find(particles::ParticleSystem& system, const std::vector<double>& concentration) {
    const particles::ParticleStore& s = system.store();
    const auto n = static_cast<std::size_t>(system.owned());
    particles::RealArray records = sidedRecords(
        system, [&](std::size_t i) { return s.kindOf(i) == particles::Kind::fluid ? volumeOf(s, i) : 0; },
        [&](std::size_t i) { return concentration[i]; });
    rates_.resize(n), speeds_.resize(n), unused_.resize(2 * n);
    double* const results[4] = {rates_.data(), unused_.data(), unused_.data() + n, speeds_.data()};
    const PairKernels::Diffusion law = pairKernels().diffusion(kernel_, system.precision());
    particles::sumOverPairs(system, law, law, {}, records, SidedRecord::fields, sums_, results);
    for (std::size_t i = 0; i < n; ++i) rates_[i] *= factor_, speeds_[i] *= factor_ / volumeOf(s, i);
}

}  // namespace corpuscle::sph
