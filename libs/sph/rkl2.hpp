// A fluid alone, its viscosity by super-time-stepping (legendreStages.hpp), so that the viscous limit of the step grows
// as the square of the number of evaluations:
//
//     x*   = x + dt/2 u,   rho* = rho + dt/2 rhodot                          then all operators are taken at x*
//     g    = forces of pressure and body at x*, rho*,    rhodot1 = R(x*) u   rate of density (fluidPair.hpp)
//     u   <- RKL2 over dt of  du/dt = L(x*, rho*) u + g,   u at the start    L: viscosity (fluidPair.hpp)
//     rhodot = R(x*) u
//     rho <- rho + dt/2 (rhodot1 + rhodot),   x <- x* + dt/2 u
//
// Motion, continuity and velocity in turn, a symmetric composition: of second order in dt. Sound is stepped as velocity
// Verlet steps it, omega dt < 2 for every drag; RKL2 of everything at once would be unstable for sound that is hardly
// damped, omega dt < 0.08 (docs/theory/timeStep.md). L does not change over a step, so only the increments d_j of its
// stages go through it: L u + g once, then L d_j. s stages take s + 1 passes over pairs; lists are looked after once a
// step.
#pragma once
#include "sph/explicitScheme.hpp"
#include "sph/flow.hpp"
#include "sph/fluidForces.hpp"
#include "sph/legendreStages.hpp"
#include "sph/shifting.hpp"
#include "sph/stepLimits.hpp"

namespace corpuscle::sph {

struct Rkl2Settings {
    long stages = 31;        // of a step, at most; odd
    double resolution = 40;  // steps, at least, in the time in which the flow changes by itself
    static const Schema<Rkl2Settings>& schema();
    // Largest dt that follows what the flow does by itself, at t after its start: t/resolution where it settles, but
    // not less than 2/lambda, as at a start from rest; its time over the resolution where it decays; infinity where it
    // is developed.
    double accurateStep(const FlowState& flow, double t, double lambda) const;
    // That, and what so many stages bear. lambda: largest rate of the viscous operator, reserve included [1/s].
    void addLimits(const FlowState& flow, double t, double lambda, StepLimits& limits) const;
};

class Rkl2 final : public ExplicitScheme {
  public:
    // Acoustic limit over velocity Verlet's, which has a reserve of 7 on a lattice: omega dt below 0.9 for all waves,
    // of the 2 that are stable. Velocity Verlet's steps are seldom bound by it, those of RKL2 often.
    static constexpr double acousticReach = 3;

    // budget: null, or what is to be kept; its rates are the means of those with the velocities of the step's beginning
    // and end, at x*.
    Rkl2(particles::ParticleSystem& system, FluidForces& forces, Shifting* shifting, Budget* budget = nullptr);

    void start() override;
    void resume() override;
    void advance(double dt) override;  // with as many stages as the rate asks for

    // Largest rate of the viscous operator, reserve included [1/s].
    void setRate(double lambda) { rate_ = lambda; }
    int stages(double dt) const { return LegendreStages::needed(rate_ * dt); }

  private:
    using Vectors = particles::RealArray[3];
    void drift(double dt);
    void findIncrement(double dt);
    particles::ParticleSystem& system_;
    FluidForces& forces_;
    Shifting* shifting_;
    Budget* budget_;
    double rate_ = 0;
    Vectors increment_, before_, viscous_;
    particles::RealArray densityRate_;
};

}  // namespace corpuscle::sph
