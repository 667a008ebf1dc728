// Advances a scene by the scheme of its case, in steps as large as every limit allows (sph/stepLimits.hpp). A step that
// an event shortens (core/time.hpp) says nothing about the length of the next one.
#pragma once
#include <limits>
#include <memory>

#include "core/time.hpp"
#include "schemes/stepper.hpp"
#include "simulation/case.hpp"

namespace corpuscle::simulation {

// Name, length, and which one binds; for the log.
std::vector<std::vector<std::string>> limitRows(const sph::StepLimits& limits);

class Integrator {
  public:
    // The scene must stay where it is: its coupling and loads refer to it.
    Integrator(const Case& input, coupling::Scene& scene);

    void start(Time& time);  // forces at the initial state, first step
    struct State {
        double dt = 0;
        std::vector<double> scheme;
    };
    State state(const Time& time) const { return {time.dt, stepper_->state()}; }
    void resume(const State& state, Time& time);  // after a restart
    // The same where the scene has been rolled back within a run.
    void goBack(const State& state, Time& time);
    // From the next step that is chosen on: none longer than this [s], and by backward Euler where damped and the
    // scheme knows it.
    void shorten(double longest, bool damped);

    // One step of time.dt, shorter where one of the events comes before its end; then time is on and time.dt is what
    // the limits allow next. Collective. Throws Failure(numerics), on all ranks, where a step cannot be made.
    void advance(Time& time, const std::vector<Event>& events = {});
    double tried() const { return tried_; }  // length of the last step, made or not, had no event shortened it [s]
    bool wasShortened() const { return shortened_; }  // the last step, by an event

    const sph::StepLimits& limits() const { return limits_; }
    double largestDensityBalance() const;
    long mostFallbacks() const;  // nodes of immersed membranes with Shepard's weights at once
    const schemes::Stepper& stepper() const { return *stepper_; }

  private:
    std::unique_ptr<schemes::Stepper> makeStepper() const;
    void updateLimits(Time& time);
    const Case& input_;
    coupling::Scene& scene_;
    std::unique_ptr<schemes::Stepper> stepper_;
    sph::StepLimits limits_;
    double largestBalance_ = 0;                                 // before the last way back
    long mostFallbacks_ = 0;                                    // likewise
    double longest_ = std::numeric_limits<double>::infinity();  // step, whatever the limits allow [s]
    double tried_ = 0;
    bool shortened_ = false;
};

}  // namespace corpuscle::simulation
