// Velocity Verlet with adjoint operators (sph/operators.hpp) and immersed membranes (immersed.hpp): the equations of
// the implicit step, advanced explicitly in time.
//
//     M du/dt = -L u + D^T V p + M g + S^T P (f(x_m) - C P S u),   drho/dt = -rho D u,   dx/dt = u,   dx_m/dt = P S u
//
//     x* = x + dt/2 u,  x_m* = x_m + dt/2 u_m,  ubar = u + dt/2 a,  rhobar = rho + dt/2 rhodot
//         with a and rhodot of the previous step
//     a, rhodot evaluated at x*, x_m*, ubar, rhobar
//     u <- u + dt a,  rho <- rho + dt rhodot,  u_m <- P S u
//     x <- x* + dt/2 u,  x_m <- x_m* + dt/2 u_m
//
// symbol          | meaning                                                                     | unit
// M, V            | masses and volumes m/rhobar of the particles                                | kg, m^3
// L, D            | viscosity and divergence at x*, plain or corrected                          | N s/m, 1/s
// S, P, f, C      | interpolation to the nodes, projection that conserves the volume of closed cells, elastic force,
//                 | damping by the membrane's viscosity
// p, g            | pressure of the equation of state; body force per unit mass                 | Pa, m/s^2
//
// With x* and u in place of x and u*, this is the scheme of sph/velocityVerlet.hpp half a step later: a step needs one
// evaluation, and the limits of sph/stepLimits.hpp hold. Operators and weights are built anew in each step; only
// positions, velocities, densities and their rates are carried from one step to the next. Particles are shifted and
// kept on their side of each membrane as in the implicit step (noFlux.hpp).
#pragma once
#include <memory>

#include "coupling/adjoint.hpp"
#include "coupling/immersed.hpp"
#include "coupling/noFlux.hpp"

namespace corpuscle::coupling {

class AdjointVerlet {
  public:
    using Options = AdjointOptions;
    virtual ~AdjointVerlet() = default;

    // Computes the rates of the initial state. Not to be called after a restart, which reads them as part of the state.
    // Collective.
    virtual void start() = 0;
    // Makes one step, of length dt [s]; returns the bonds that broke in it. Collective.
    virtual std::vector<RuptureEvent> advance(double dt) = 0;

    // Rates that limit the step: the largest eigenvalues of M^-1 times the named matrix, by power iterations on the
    // operators of the last evaluation. Collective.
    struct Rates {
        double viscous = 0;   // L [1/s]
        double membrane = 0;  // S^T P C P S [1/s]
        double spring2 = 0;   // S^T P K P S, with the membranes' stiffness K by differences of their forces [1/s^2]
    };
    virtual Rates rates(int iterations) = 0;

    virtual double largestDensityBalance() const = 0;
    long steps() const { return steps_; }
    // Restores the counts of a checkpoint. crossings: those of this rank (NoFlux::crossings).
    void resume(long steps, long crossings) {
        steps_ = steps;
        if (noFlux_) noFlux_->restore(crossings);
    }
    const Immersed* immersed() const { return immersed_.get(); }
    const NoFlux* noFlux() const { return noFlux_.get(); }  // null without cells

    // Keeps a reference to the scene, which must not move in memory.
    static std::unique_ptr<AdjointVerlet> make(Scene& scene, const Options& options);

  protected:
    std::unique_ptr<Immersed> immersed_;  // null without cells
    std::unique_ptr<NoFlux> noFlux_;
    long steps_ = 0;
};

}  // namespace corpuscle::coupling
