// Steps one scene by one scheme. All of it is collective but what only returns a number.
#pragma once
#include <vector>

#include "core/log.hpp"
#include "core/runRecord.hpp"
#include "sph/stepLimits.hpp"

namespace corpuscle::schemes {

class Stepper {
  public:
    virtual ~Stepper() = default;

    // At the initial state: forces and rates.
    virtual void start() = 0;
    // What a checkpoint keeps beside the scene, and how it goes on from there.
    virtual std::vector<double> state() const = 0;
    virtual std::size_t stateSize() const = 0;
    virtual void resume(const std::vector<double>& state) = 0;
    // The step to go on with: `kept` by the checkpoint, `allowed` by the limits now [s].
    virtual double resumedStep(double kept, double /*allowed*/) const { return kept; }

    // One step of dt, planned to be longer where an event has shortened it [s]; what broke and how many particles were
    // moved back is then in the scene. Throws Failure(numerics), on all ranks, where it cannot be made.
    virtual void advance(double dt, double planned) = 0;
    // From the next step on by backward Euler, where the scheme knows it.
    virtual void damp(bool /*damped*/) {}
    // Steps and parts of steps that it has made or tried since it was made; 0: it counts none.
    virtual long tries() const { return 0; }

    // Whether limits have to be found anew after a step, the number of which is given.
    virtual bool limitsChange(long step) = 0;
    // Of the next step, at the time t [s].
    virtual sph::StepLimits limits(double t) = 0;
    virtual int stages(double /*dt*/) const {
        return 0;
    }  // evaluations of viscosity in a step of dt; 0: it has no stages

    virtual double largestDensityBalance() const { return 0; }
    virtual long mostFallbacks() const { return 0; }  // nodes of immersed membranes with Shepard's weights at once
    // What the one that it takes the place of, of the same scheme, has counted.
    virtual void takeOver(const Stepper& /*before*/) {}
    // Figures of so many steps, at the end of a run.
    virtual void report(RunRecord&, Log&, long /*steps*/) const {}
};

}  // namespace corpuscle::schemes
