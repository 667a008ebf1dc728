// Particle shifting: moves fluid particles from where they are dense to where they are sparse, so that disorder does
// not grow.
//     x_i <- x_i + C H_s^2 (rate tau) sum_j V_j F x_ij        at most 0.05 dx
// C: coefficient; rate: shear rate of the flow, or speed/length where it has none [1/s]; tau: time since the last
// shift. Particles are shifted every `steps` time steps. Only fluid particles move; velocity and density stay with the
// particle.
#pragma once
#include <memory>
#include <optional>

#include "particles/particleSystem.hpp"
#include "sph/kernel.hpp"

namespace corpuscle::sph {

struct ShiftingSettings {
    double coefficient = 1;
    long steps = 10;
    std::optional<double> densityRate;         // of coupling/adjoint.hpp; empty: automatic
    std::optional<double> backgroundPressure;  // likewise [Pa]
    static const Schema<ShiftingSettings>& schema();
};

class Shifting {
  public:
    Shifting(const ShiftingSettings& settings, const Kernel& kernel, double support, double rate, double particleMass);

    // Counts one step and returns whether particles are to be shifted in it.
    bool due() { return ++count_ % settings_.steps == 0; }
    void apply(particles::ParticleSystem& system, double dt);

    long count() const { return count_; }
    void restore(long count) { count_ = count; }
    double largest() const { return largest_; }  // largest displacement in the last shift on this rank [m]

  private:
    ShiftingSettings settings_;
    DisorderConstants constants_;
    KernelKind kernel_;
    double support_, rate_, mass_, largest_ = 0;
    long count_ = 0;
    particles::RealArray records_, sums_, disorder_[4];
};

}  // namespace corpuscle::sph
