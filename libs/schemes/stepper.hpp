// Advances one scene by one scheme. All functions are collective, except those that only return a number.
#pragma once
#include <vector>

#include "core/log.hpp"
#include "core/runRecord.hpp"
#include "sph/stepLimits.hpp"

namespace corpuscle::schemes {

class Stepper {
  public:
    virtual ~Stepper() = default;

    // Forces and rates at the initial state.
    virtual void start() = 0;
    // What a checkpoint keeps in addition to the scene; resume() continues from it.
    virtual std::vector<double> state() const = 0;
    virtual std::size_t stateSize() const = 0;
    virtual void resume(const std::vector<double>& state) = 0;
    // The step with which a restart continues. kept: that of the checkpoint; allowed: by the present limits [s].
    virtual double resumedStep(double kept, double /*allowed*/) const { return kept; }

    // Makes one step of dt, or a shorter one that ends where a bond breaks, and returns its length; planned: its length
    // without an event that has shortened it [s]. What broke and how many particles were moved back is then in the
    // scene. Throws Failure(numerics), on all ranks, if the step cannot be made.
    virtual double advance(double dt, double planned) = 0;
    // Sets whether the next steps are made by backward Euler, if the scheme has it.
    virtual void damp(bool /*damped*/) {}
    // Steps and parts of steps that this stepper has made or tried so far; 0: it does not count them.
    virtual long tries() const { return 0; }

    // Whether limits must be recomputed after the step with this number.
    virtual bool limitsChange(long step) = 0;
    // Limits of the next step, at the time t [s].
    virtual sph::StepLimits limits(double t) = 0;
    virtual int stages(double /*dt*/) const {
        return 0;
    }  // evaluations of viscosity in a step of dt; 0: it has no stages

    virtual double largestDensityBalance() const { return 0; }
    // Largest number at one time of nodes of immersed membranes with a share of the plain mean (nodeFluidMap.hpp).
    virtual long mostFallbacks() const { return 0; }
    // Takes over the counts of `before`, a stepper of the same scheme that this one replaces.
    virtual void takeOver(const Stepper& /*before*/) {}
    // Reports figures of this many steps, at the end of a run.
    virtual void report(RunRecord&, Log&, long /*steps*/) const {}
};

}  // namespace corpuscle::schemes
