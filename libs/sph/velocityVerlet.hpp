// Velocity Verlet with density (paper, Eqs 12 to 17), on every particle of a rank:
//
//     u* = u + dt/2 a,  rho* = rho + dt/2 rhodot,  ubar = u + dt a             (12, 13, 14)
//     x <- x + dt u*                                                           (15)
//     a, rhodot from x, ubar, rhobar = rho* + dt/2 rhodot                      (5, 6)
//     u <- u* + dt/2 a,  rho <- rho* + dt/2 rhodot                             (16, 17)
//
// ubar is u* + dt/2 a with the acceleration of the step's beginning, so that nothing is kept for it; rhobar likewise.
// The paper takes the pressure from rho*, half a step behind the positions: that is of first order in dt and feeds
// sound of angular frequency omega at the rate omega^2 dt/4, which viscosity must then take away. With rhobar the
// scheme is of second order. What else acts on particles joins as a Load; a scene without one pays nothing.
#pragma once
#include <vector>

#include "sph/explicitScheme.hpp"
#include "sph/fluidForces.hpp"
#include "sph/shifting.hpp"

namespace corpuscle::sph {

class Load {
  public:
    virtual ~Load() = default;
    // For particles that do not move by their own accelerations: all have been moved by Eqs 12 to 15 over dt, lists are
    // as they were; and, at the end of the step, by Eqs 16 and 17.
    virtual void drifted(particles::ParticleSystem&, double /*dt*/) {}
    virtual void kicked(particles::ParticleSystem&, double /*dt*/) {}
    // Particles have moved; lists may have been rebuilt (then `rebuilt` is set and every index has changed). The
    // velocity that forces are computed with is u + extrapolation f. Collective.
    virtual void moved(particles::ParticleSystem& system, double extrapolation, bool rebuilt) = 0;
    // Adds to fx, fy, fz [m/s^2] of the owned particles. Collective.
    virtual void addAccelerations(particles::ParticleSystem& system) = 0;
    // What it does for the budget of this evaluation, after addAccelerations; this rank's part.
    virtual void addRates(const particles::ParticleSystem&, const FluidForces&, Budget::Values&) const {}
};

class VelocityVerlet final : public ExplicitScheme {
  public:
    // budget: null, or what is to be kept; its rates are added by the trapezoidal rule, as velocities are.
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
