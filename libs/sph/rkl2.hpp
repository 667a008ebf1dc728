// Scheme for a fluid alone, with super-time-stepping for viscosity (legendreStages.hpp), so that the viscous limit of
// the step grows as the square of the number of evaluations:
//
//     x*   = x + dt/2 u,   rho* = rho + dt/2 rhodot                          all operators are evaluated at x*
//     g    = forces of pressure and body at x*, rho*,    rhodot1 = R(x*) u   rate of density (fluidPair.hpp)
//     u   <- RKL2 over dt of  du/dt = L(x*, rho*) u + g,   u at the start    L: viscosity (fluidPair.hpp)
//     rhodot = R(x*) u
//     rho <- rho + dt/2 (rhodot1 + rhodot),   x <- x* + dt/2 u
//
// Motion, continuity and velocity are advanced in turn, in a symmetric composition: the scheme is of second order in
// dt. Sound is advanced as by velocity Verlet, stable for omega dt < 2 with any drag; RKL2 for everything at once would
// require omega dt < 0.08 for weakly damped sound (docs/theory/timeStep.md). L does not change during a step, so it is
// applied only to the increments d_j of the stages: L u + g once, then L d_j. s stages take s + 1 passes over pairs;
// lists are checked once per step.
#pragma once
#include "sph/explicitScheme.hpp"
#include "sph/flow.hpp"
#include "sph/fluidForces.hpp"
#include "sph/legendreStages.hpp"
#include "sph/shifting.hpp"
#include "sph/stepLimits.hpp"

namespace corpuscle::sph {

struct Rkl2Settings {
    long stages = 31;        // largest number of stages in a step; odd
    double resolution = 40;  // least number of steps in the time in which an unsteady flow changes
    static const Schema<Rkl2Settings>& schema();
    // Largest dt that resolves the flow's own change, at time t after its start: t/resolution if the flow settles (as
    // from rest), but not less than 2/lambda; flow.transient/resolution if the flow decays; infinity if it is fully
    // developed.
    double accurateStep(const FlowState& flow, double t, double lambda) const;
    // Adds this limit, and the viscous limit for `stages` stages. lambda: largest rate of the viscous operator, with
    // its reserve [1/s].
    void addLimits(const FlowState& flow, double t, double lambda, StepLimits& limits) const;
};

class Rkl2 final : public ExplicitScheme {
  public:
    // Acoustic limit divided by that of velocity Verlet, which has a reserve of a factor 7 on a lattice. With this
    // factor omega dt is below 0.9 for all waves, while 2 is stable. The limit seldom binds with velocity Verlet, but
    // often with RKL2.
    static constexpr double acousticReach = 3;

    // budget: the budget to be kept, or null. Its rates are means of those with the velocities at the beginning and at
    // the end of the step, both at x*.
    Rkl2(particles::ParticleSystem& system, FluidForces& forces, Shifting* shifting, Budget* budget = nullptr);

    void start() override;
    void resume() override;
    void advance(double dt) override;  // with stages(dt) stages

    // Sets the largest rate of the viscous operator, with its reserve [1/s].
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
