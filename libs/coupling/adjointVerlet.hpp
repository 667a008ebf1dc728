// Velocity Verlet on adjoint operators (sph/operators.hpp), membranes immersed in the fluid (immersed.hpp): the
// equations that the implicit step solves, explicit in time.
//
//     M du/dt = -L u + D^T V p + M g + S^T P (f(x_m) - C P S u),   drho/dt = -rho D u,   dx/dt = u,   dx_m/dt = P S u
//
//     x* = x + dt/2 u,  x_m* = x_m + dt/2 u_m,  ubar = u + dt/2 a,  rhobar = rho + dt/2 rhodot
//         with a and rhodot of the last step
//     a, rhodot from x*, x_m*, ubar, rhobar
//     u <- u + dt a,  rho <- rho + dt rhodot,  u_m <- P S u
//     x <- x* + dt/2 u,  x_m <- x_m* + dt/2 u_m
//
// symbol          | meaning                                                                     | unit
// M, V            | masses and volumes m/rhobar of the particles                                | kg, m^3
// L, D            | viscosity and divergence at x*, plain or corrected                          | N s/m, 1/s
// S, P, f, C      | interpolation of the nodes, projection that keeps volumes, elastic force, damping by the membrane's
//                 | viscosity
// p, g            | pressure of the equation of state; body force per unit mass                 | Pa, m/s^2
//
// With x* and u in the places of x and u* this is the scheme of sph/velocityVerlet.hpp half a step on, so that one
// evaluation is made in each step and the limits of sph/stepLimits.hpp hold. Whatever a step needs is made within it:
// the state between steps is places, velocities, densities and their rates alone. Particles are shifted and kept on
// their side of each membrane as in the implicit step (noFlux.hpp).
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

    // Rates at the initial state. Not after a restart: they are part of the state. Collective.
    virtual void start() = 0;
    // One step; what broke in it. Collective.
    virtual std::vector<RuptureEvent> advance(double dt) = 0;

    // What limits the step, by power iterations on the operators of the last evaluation. Collective.
    struct Rates {
        double viscous = 0;   // largest eigenvalue of M^-1 L [1/s]
        double membrane = 0;  // of M^-1 S^T P C P S [1/s]
        double spring2 = 0;   // of M^-1 S^T P K P S, K the membranes' stiffness by differences of their forces [1/s^2]
    };
    virtual Rates rates(int iterations) = 0;

    virtual double largestDensityBalance() const = 0;
    long steps() const { return steps_; }
    void resume(long steps, long crossings) {  // crossings: of this rank
        steps_ = steps;
        if (noFlux_) noFlux_->restore(crossings);
    }
    const Immersed* immersed() const { return immersed_.get(); }
    const NoFlux* noFlux() const { return noFlux_.get(); }  // none without cells

    // The scene must stay where it is.
    static std::unique_ptr<AdjointVerlet> make(Scene& scene, const Options& options);

  protected:
    std::unique_ptr<Immersed> immersed_;  // none without cells
    std::unique_ptr<NoFlux> noFlux_;
    long steps_ = 0;
};

}  // namespace corpuscle::coupling
