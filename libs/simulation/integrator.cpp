#include "simulation/integrator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace corpuscle::simulation {

std::vector<std::vector<std::string>> limitRows(const sph::StepLimits& limits) {
    const std::string stages = limits.stages > 0 ? ": " + std::to_string(limits.stages) + " stages" : "";
    const std::string binding = limits.binding().name;
    std::vector<std::vector<std::string>> rows;
    for (const sph::StepLimit& limit : limits.all)
        rows.push_back(
            {limit.name, formatQuantity(limit.seconds, unit::second), limit.name == binding ? "binding" + stages : ""});
    return rows;
}

Integrator::Integrator(const Case& input, coupling::Scene& scene)
    : input_(input), scene_(scene), stepper_(makeStepper()) {}

std::unique_ptr<schemes::Stepper> Integrator::makeStepper() const {
    return input_.scheme().stepper(input_.facts(), input_.numerics, scene_);
}

void Integrator::start(Time& time) {
    scene_.driveAt(time.t);
    stepper_->start();
    updateLimits(time);
}

void Integrator::resume(const State& state, Time& time) {
    if (state.scheme.size() != stepper_->stateSize())
        throw Failure(ExitCode::io, fmt::format("the checkpoint holds {} numbers of the scheme's state in place of {}: "
                                                "another version wrote it; start from firstTime",
                                                state.scheme.size(), stepper_->stateSize()));
    scene_.driveAt(time.t);
    stepper_->resume(state.scheme);
    updateLimits(time);
    time.dt = stepper_->resumedStep(state.dt, time.dt);
}

void Integrator::goBack(const State& state, Time& time) {
    largestBalance_ = largestDensityBalance();
    mostFallbacks_ = mostFallbacks();
    const std::unique_ptr<schemes::Stepper> before = std::exchange(stepper_, makeStepper());
    stepper_->takeOver(*before);
    resume(state, time);
}

void Integrator::shorten(double longest, bool damped) {
    longest_ = longest;
    stepper_->damp(damped);
}

void Integrator::advance(Time& time, const std::vector<Event>& events) {
    const double dt = time.shorten(events);
    tried_ = time.dt, shortened_ = dt < time.dt;
    scene_.now = time.t;
    const double made = stepper_->advance(dt, time.dt);
    if (made < dt) time.aim.reset(), shortened_ = true;
    time.advance(made);
    if (scene_.control) scene_.control->follow(scene_, time.t, made);
    scene_.driveAt(time.t);
    if (stepper_->limitsChange(time.step)) updateLimits(time);
}

double Integrator::largestDensityBalance() const {
    return std::max(stepper_->largestDensityBalance(), largestBalance_);
}

long Integrator::mostFallbacks() const { return std::max(stepper_->mostFallbacks(), mostFallbacks_); }

void Integrator::updateLimits(Time& time) {
    limits_ = stepper_->limits(time.t);
    if (longest_ < std::numeric_limits<double>::infinity()) limits_.add("rollback", longest_);
    time.dt = limits_.binding().seconds;
    limits_.stages = stepper_->stages(time.dt);
}

}  // namespace corpuscle::simulation
