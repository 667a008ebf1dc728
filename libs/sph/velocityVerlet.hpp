// Velocity Verlet with density (paper, Eqs 12 to 17), on every particle of a rank:
//
//     u* = u + dt/2 a,  rho* = rho + dt/2 rhodot,  ubar = u + dt a             (12, 13, 14)
//     x <- x + dt u*                                                           (15)
//     a, rhodot from x, ubar, rhobar = rho* + dt/2 rhodot                      (5, 6)
//     u <- u* + dt/2 a,  rho <- rho* + dt/2 rhodot                             (16, 17)
//
// ubar is computed as u* + dt/2 a with the acceleration from the beginning of the step, so that it needs no memory;
// rhobar likewise. The paper takes the pressure from rho*, half a step behind the positions: this is of first order in
// dt and amplifies sound of angular frequency omega at the rate omega^2 dt/4, which viscosity must compensate. With
// rhobar the scheme is of second order. Other actions on particles are added as a Load; a scene without loads has no
// extra cost.
#pragma once
#include <vector>

#include "sph/explicitScheme.hpp"
#include "sph/fluidForces.hpp"
#include "sph/shifting.hpp"

namespace corpuscle::sph {

class Load {
  public:
    virtual ~Load() = default;
    // For loads whose particles do not move by their own accelerations. drifted: all particles have been moved by Eqs
    // 12 to 15 over dt, with unchanged lists. kicked: at the end of the step, Eqs 16 and 17 have been applied to all
    // particles.
    virtual void drifted(particles::ParticleSystem&, double /*dt*/) {}
    virtual void kicked(particles::ParticleSystem&, double /*dt*/) {}
    // Called when particles have moved; if lists have been rebuilt, `rebuilt` is set and every index has changed.
    // Forces are computed with the velocity u + extrapolation f, f the last acceleration. Collective.
    virtual void moved(particles::ParticleSystem& system, double extrapolation, bool rebuilt) = 0;
    // Adds to fx, fy, fz [m/s^2] of the owned particles. Collective.
    virtual void addAccelerations(particles::ParticleSystem& system) = 0;
    // Adds the contribution of this load to the budget's rates, after addAccelerations; this rank's part.
    virtual void addRates(const particles::ParticleSystem&, const FluidForces&, Budget::Values&) const {}
};

class VelocityVerlet final : public ExplicitScheme {
  public:
    // budget: the budget to be kept, or null. Its rates are summed by the trapezoidal rule, as velocities are.
    VelocityVerlet(particles::ParticleSystem& system, FluidForces& forces, Shifting* shifting, std::vector<Load*> loads,
                   Budget* budget = nullptr);

    void start() override;  // with ubar = u
    void resume() override;
    void advance(double dt) override;

    long rebuilds() const { return system_.rebuilds(); }

  private:
    void evaluate(double extrapolation, bool rebuilt);
    particles::ParticleSystem& system_;
    FluidForces& forces_;
    Shifting* shifting_;
    std::vector<Load*> loads_;
    Budget* budget_;
};

}  // namespace corpuscle::sph
