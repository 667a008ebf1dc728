// One implicit step for fluid and membrane: a symmetric positive-definite system for the velocity v at the midpoint of
// the step,
//
//     [c1 M + L + (dt/2 + e) D^T V K D + S^T P ((dt/2 + e) k + C) P S] v =
//         M (c1 u + c2 a) + D^T V (p^n + e K D v0) + f_body + S^T P (f(x*) + k (dt/2 u_m + e P S v0))
//     x <- x + dt v,   rho <- rho (1 - dt/2 D v)/(1 + dt/2 D v),   x_m <- x_m + dt P S v
//
// symbol       | meaning
// M, V         | masses and volumes m/rho of the particles
// L, D         | viscosity and divergence (sph/operators.hpp), at the positions x* at the midpoint of the step
// K            | bulk modulus rho c^2, dp = -K D v dt
// S, P, k, f   | interpolation to the membrane nodes, projection that keeps the volume of cells, stiffness and
//              | elastic force of the membranes (coupling/immersed.hpp)
// C            | damping by the membrane's own viscosity
// x*           | x^n + dt/2 u, u: velocity at the midpoint of the last step; u_m: the same of the nodes
// a            | acceleration between the midpoints of the last two steps
// e, v0        | 0.02 dt, and u + h a, the velocity extrapolated from the last two steps
//
// Each of these but inertia and the body force is a Term (term.hpp); a scene has only the terms of what it contains.
//
// dv/dt at the midpoint of the step is c1 (v - u) - c2 a, the second-order backward difference over the midpoints of
// three steps: with h the time between the last two midpoints and w = h/h_before, c1 = (1 + 2w)/(h (1 + w)),
// c2 = w/(1 + w). It damps stiff modes, which the midpoint rule u^(n+1) = 2v - u^n would let oscillate. Elastic forces,
// of membranes and bulk, need damping as well: a deviation x^n far stiffer than the fluid would return as -x^n at the
// next step, with a velocity 2 x^n/dt, which looks the worse the shorter the step. Elastic forces are therefore
// evaluated at x* + dt/2 (v - u) + e (v - v0). The last part, with the second difference of the velocity, is an error
// of third order in the step. It halves the stiffest deviation in each step (the largest root of
// 0.52 r^3 + 0.44 r^2 + 0.06 r - 0.02; this root is least for e = 0.0185 dt). In the first two steps, where v0 does not
// include the effect of the forces yet, e is 0; if the flow starts fully developed, in the first step alone.
//
// Walls have prescribed velocities: their rows and columns are removed, which keeps the system symmetric. Pressure
// needs no saddle-point problem: the density carries it from step to step. Backward Euler: everything at the end of the
// step, dt in place of dt/2, c1 = 1/h, c2 = 0 and e = 0, with h = dt but after a midpoint step (timeDifference.hpp).
//
// Membrane forces are nonlinear: the difference between these forces at the computed positions and the linearised ones
// is solved for again with the same matrix, as long as it is above `linearisation` of the disturbance in the energy
// norm, and at most `mostRefinements` times. Where the solver does not converge, a bond would change by more than the
// case allows or membranes would meet, the step is undone and made in two halves by backward Euler.
//
// Rupture. Where a bond breaks within the step, the step is undone and made again with such a length that it ends there
// (breakSearch.hpp). The velocity jumps at that time: the next step starts from the velocity at the end of this one,
// is made by backward Euler, and knows no acceleration from before.
//
// State between steps: positions at t^n, and in the store the acceleration a and the velocity at t^n,
// u + (t^n - t_middle) a, of second order like the rest of the scheme; the next step converts it back to u. After the
// first step the store has u itself, unless the flow starts fully developed: without cells, bodies or jumps of
// viscosity, and without walls or a body force that start it from rest. Membrane nodes keep their velocity at the
// midpoint, and forces on walls and bodies are those at the midpoint.
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

    struct Made {
        double length = 0;                             // of the step [s]
        std::vector<coupling::RuptureEvent> broken{};  // at its end
    };
    // Makes one step of dt, or a shorter one that ends where bonds break. Collective. Throws Failure(numerics) if
    // repeated halving does not help. planned: length that the step would have without an event that shortens it
    // (core/time.hpp) [s].
    virtual Made advance(double dt, double planned) = 0;
    Made advance(double dt) { return advance(dt, dt); }

    bool damped = false;  // every step by backward Euler, whatever the case says

    using State = StepState;
    State state;
    void resume(const State& saved, long crossings) {  // crossings: those counted by this rank
        state = saved;
        allowed_ = {};
        if (noFlux_) noFlux_->restore(crossings);
    }

    struct Statistics {
        long steps = 0, iterations = 0, mostIterations = 0;
        long refinements = 0, halvings = 0;
        long breaks = 0, breakTries = 0;  // steps that ended with a break; solves beyond the first that these took
        long coarseBreaks = 0;            // of them, those that could not be made to end closely enough
        long innerIterations = 0;         // of the system on the nodes (membraneCorrection.hpp)
    };
    Statistics statistics;
    virtual double largestDensityBalance() const = 0;
    // Limits of the next step, by the last one (stepControl.hpp).
    const AllowedSteps& allowed() const { return allowed_; }
    const coupling::Immersed* immersed() const { return immersed_.get(); }
    const coupling::NoFlux* noFlux() const { return noFlux_.get(); }

    // The scene is kept by reference.
    static std::unique_ptr<ImplicitStep> make(coupling::Scene& scene, const Options& options);

  protected:
    ImplicitStep(std::unique_ptr<coupling::Immersed> immersed, std::unique_ptr<coupling::NoFlux> noFlux)
        : immersed_(std::move(immersed)), noFlux_(std::move(noFlux)) {}
    std::unique_ptr<coupling::Immersed> immersed_;  // null without cells
    std::unique_ptr<coupling::NoFlux> noFlux_;
    AllowedSteps allowed_;
};

}  // namespace corpuscle::implicit
