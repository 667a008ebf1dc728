#include "sph/shifting.hpp"

#include <algorithm>

#include "particles/sumOverPairs.hpp"

namespace corpuscle::sph {

namespace {
constexpr double largestInSpacings = 0.05;
}

const Schema<ShiftingSettings>& ShiftingSettings::schema() {
    static const Schema<ShiftingSettings> s =
        Schema<ShiftingSettings>("shifting", "particle shifting")
            .quantity("coefficient", &ShiftingSettings::coefficient, unit::none, "C, strength per unit of strain",
                      {.fallback = "1", .range = positive})
            .integer("steps", &ShiftingSettings::steps, "time steps between two shifts",
                     {.fallback = "10", .range = atLeast(1)})
            .quantityOr("auto", "densityRate", &ShiftingSettings::densityRate, unit::none,
                        "rate at which densities follow the number of particles, over that of the flow; auto: 1 to 10, "
                        "by the pressure drop, in vessels without cells whose cross-section varies, else 0",
                        {.fallback = "auto", .range = between(0, 100)})
            .quantityOr("auto", "backgroundPressure", &ShiftingSettings::backgroundPressure, unit::pascal,
                        "pressure added everywhere, so that the fluid is not under tension and does not part; auto: "
                        "two thirds of the expected pressure drop where there are cells and the cross-section of the "
                        "vessel varies, else 0",
                        {.fallback = "auto", .range = atLeast(0)})
            .atRestart(AtRestart::noted, {"coefficient", "steps", "densityRate", "backgroundPressure"});
    return s;
}

Shifting::Shifting(const ShiftingSettings& settings, const Kernel& kernel, double support, double rate,
                   double particleMass)
    : settings_(settings),
      constants_{support, kernel.normalisation(support), kernel.gradientNormalisation(support)},
      kernel_(kernel.kind()),
      support_(support),
      rate_(rate),
      mass_(particleMass) {}

void Shifting::apply(particles::ParticleSystem& system, double dt) {
    using particles::Kind;
    particles::ParticleStore& s = system.store();
    // The list must be valid for the present positions. Since the last check particles have moved by one step, which
    // the skin allows for.
    const auto n = static_cast<std::size_t>(system.owned());
    records_.resize((n + static_cast<std::size_t>(system.ghosts())) * 4);
    for (auto& d : disorder_) d.resize(n);
    const bool varyingMass = s.optional().mass;
    const particles::RecordFrame frame(system);
    for (std::size_t i = 0; i < n; ++i) {
        double* r = records_.data() + 4 * i;
        frame.position(i, r);
        r[3] = (varyingMass ? s.mass[i] : mass_) / s.density[i];
    }
    double* const results[4] = {disorder_[0].data(), disorder_[1].data(), disorder_[2].data(), disorder_[3].data()};
    const PairKernels::Disorder disorder = pairKernels().disorder(kernel_, system.precision());
    particles::sumOverPairs(system, disorder, disorder, constants_, records_, 4, sums_, results);
    const double factor =
        settings_.coefficient * support_ * support_ * rate_ * dt * static_cast<double>(settings_.steps);
    const double bound = largestInSpacings * system.spacing();
    largest_ = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (s.kindOf(i) != Kind::fluid) continue;
        Vec3 shift = factor * Vec3(disorder_[0][i], disorder_[1][i], disorder_[2][i]);
        const double length = shift.norm();
        if (length > bound) shift *= bound / length;
        largest_ = std::max(largest_, std::min(length, bound));
        s.x[i] += shift[0], s.y[i] += shift[1], s.z[i] += shift[2];
    }
}

}  // namespace corpuscle::sph
