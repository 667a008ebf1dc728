// Advances a scene by the scheme of its case, in steps as large as all limits allow (sph/stepLimits.hpp). A step that
// is shortened to end at an event (core/time.hpp) does not affect the length of the next one.
#pragma once
#include <limits>
#include <memory>

#include "core/time.hpp"
#include "schemes/stepper.hpp"
#include "simulation/case.hpp"

namespace corpuscle::simulation {

// A row for the log for each limit: its name, its length, and whether it is the binding one.
std::vector<std::vector<std::string>> limitRows(const sph::StepLimits& limits);

class Integrator {
  public:
    // The scene must not be moved in memory: its coupling and loads refer to it.
    Integrator(const Case& input, coupling::Scene& scene);

    void start(Time& time);  // evaluates forces at the initial state and the length of the first step
    struct State {
        double dt = 0;
        std::vector<double> scheme;
    };
    State state(const Time& time) const { return {time.dt, stepper_->state()}; }
    void resume(const State& state, Time& time);  // after a restart
    // The same after a rollback of the scene within a run.
    void goBack(const State& state, Time& time);
    // From the next choice of a step on, no step is longer than `longest` [s]; if `damped`, steps are made by backward
    // Euler where the scheme supports it.
    void shorten(double longest, bool damped);

    // Makes one step of time.dt, shortened if one of the events lies before its end. Afterwards `time` has advanced,
    // and time.dt is what the limits allow for the next step. Throws Failure(numerics), on all ranks, if the step
    // cannot be made. Collective.
    void advance(Time& time, const std::vector<Event>& events = {});
    double tried() const { return tried_; }  // length of the last attempted step, before shortening for an event [s]
    // Whether an event or a bond that broke shortened the last step.
    bool wasShortened() const { return shortened_; }

    const sph::StepLimits& limits() const { return limits_; }
    double largestDensityBalance() const;
    long mostFallbacks() const;  // most nodes of immersed membranes with a plain mean at one time
    const schemes::Stepper& stepper() const { return *stepper_; }

  private:
    std::unique_ptr<schemes::Stepper> makeStepper() const;
    void updateLimits(Time& time);
    const Case& input_;
    coupling::Scene& scene_;
    std::unique_ptr<schemes::Stepper> stepper_;
    sph::StepLimits limits_;
    double largestBalance_ = 0;                                 // before the last rollback
    long mostFallbacks_ = 0;                                    // likewise
    double longest_ = std::numeric_limits<double>::infinity();  // largest step, whatever the limits allow [s]
    double tried_ = 0;
    bool shortened_ = false;
};

}  // namespace corpuscle::simulation
