// One implicit step for fluid and membrane: a symmetric positive-definite system for the velocity v in the middle of
// the step,
//
//     [c1 M + L + (dt/2 + e) D^T V K D + S^T P ((dt/2 + e) k + C) P S] v =
//         M (c1 u + c2 a) + D^T V (p^n + e K D v0) + f_body + S^T P (f(x*) + k (dt/2 u_m + e P S v0))
//     x <- x + dt v,   rho <- rho (1 - dt/2 D v)/(1 + dt/2 D v),   x_m <- x_m + dt P S v
//
// symbol       | meaning
// M, V         | masses and volumes m/rho of the particles
// L, D         | viscosity and divergence (sph/operators.hpp), at the places x* in the middle of the step
// K            | bulk modulus rho c^2, dp = -K D v dt
// S, P, k, f   | membrane's interpolation, its volume kept, its stiffness and elastic force (coupling/immersed.hpp)
// C            | damping by the membrane's own viscosity
// x*           | x^n + dt/2 u with the velocity u of the middle of the last step; u_m likewise of nodes
// a            | acceleration from the middle of the step before the last to that of the last
// e, v0        | 0.02 dt, and u + h a, the velocity extrapolated from the last two steps
//
// Each of these but inertia is a Term (term.hpp); a scene has those of what is in it.
//
// dv/dt in the middle of the step is c1 (v - u) - c2 a, the backward difference of second order over the middles of
// three steps: with h the time between the last two and w = h/h_before, c1 = (1 + 2w)/(h (1 + w)), c2 = w/(1 + w). It
// damps what is stiff, which the midpoint rule u^(n+1) = 2v - u^n would leave ringing. Likewise with what is elastic,
// membranes and bulk: a deviation x^n far stiffer than the fluid would come back as -x^n from step to step, with a
// velocity 2 x^n/dt that looks the worse the shorter the step. Elastic forces are therefore those at x* + dt/2 (v - u)
// + e (v - v0): the second difference of the velocity is an error of third order in the step, and the stiffest
// deviation comes back as half of itself (the largest root of 0.52 r^3 + 0.44 r^2 + 0.06 r - 0.02; of all e, 0.0185 dt
// has the least). In the first two steps, where v0 knows nothing of the forces, e is 0; in the first alone, of a flow
// that starts fully developed. Walls have prescribed velocities: their rows and columns are taken out, which keeps the
// system symmetric. Pressure needs no saddle point: density carries it from step to step. Backward Euler: everything at
// the end of the step, dt in place of dt/2, c1 = 1/dt, c2 = 0 and e = 0.
//
// Membranes are not linear: what their forces at the places found differ from the linear ones is solved for again, with
// the same matrix, while it is above `linearisation` of the disturbance in the norm of energy, and at most
// `mostRefinements` times. Where the solver does not converge, or a bond would change by more than the case allows, the
// step is taken back and made in two halves by backward Euler.
//
// The state between steps: places at t^n, and in the store the acceleration a and the velocity there, u + (t^n -
// t_middle) a, of second order as all else; the next step takes it back to u. After the first step it is u itself, but
// for a flow that goes on as it begins, without cells, bodies, jumps of viscosity and what sets in. Nodes of membranes
// keep the velocity of the middle, and forces on walls and bodies are those of the middle.
#pragma once
#include <memory>
#include <utility>

#include "coupling/adjoint.hpp"
#include "coupling/immersed.hpp"
#include "coupling/noFlux.hpp"
#include "implicit/implicitSettings.hpp"
#include "implicit/stepControl.hpp"
#include "implicit/timeDifference.hpp"

namespace corpuscle::implicit {

class ImplicitStep {
  public:
    struct Options : coupling::AdjointOptions {
        ImplicitSettings settings;
    };
    virtual ~ImplicitStep() = default;
    static constexpr double linearisation = 0.01;
    static constexpr int mostRefinements = 3, mostHalvings = 5;

    // One step; what broke in it. Collective. Throws Failure(numerics) when halves of halves do not help. planned: its
    // length but for an event that shortens it (core/time.hpp) [s].
    virtual std::vector<coupling::RuptureEvent> advance(double dt, double planned) = 0;
    std::vector<coupling::RuptureEvent> advance(double dt) { return advance(dt, dt); }

    bool damped = false;  // every step by backward Euler, whatever the case says

    using State = StepState;
    State state;
    void resume(const State& saved, long crossings) {  // crossings: of this rank
        state = saved;
        allowed_ = {};
        if (noFlux_) noFlux_->restore(crossings);
    }

    struct Statistics {
        long steps = 0, iterations = 0, mostIterations = 0;
        long refinements = 0, halvings = 0;
        long innerIterations = 0;  // on the nodes, by membraneCorrection.hpp
    };
    Statistics statistics;
    virtual double largestDensityBalance() const = 0;
    const AllowedSteps& allowed() const { return allowed_; }  // by the last one; stepControl.hpp
    const coupling::Immersed* immersed() const { return immersed_.get(); }
    const coupling::NoFlux* noFlux() const { return noFlux_.get(); }

    // The scene must stay where it is.
    static std::unique_ptr<ImplicitStep> make(coupling::Scene& scene, const Options& options);

  protected:
    ImplicitStep(std::unique_ptr<coupling::Immersed> immersed, std::unique_ptr<coupling::NoFlux> noFlux)
        : immersed_(std::move(immersed)), noFlux_(std::move(noFlux)) {}
    std::unique_ptr<coupling::Immersed> immersed_;  // none without cells
    std::unique_ptr<coupling::NoFlux> noFlux_;
    AllowedSteps allowed_;
};

}  // namespace corpuscle::implicit
