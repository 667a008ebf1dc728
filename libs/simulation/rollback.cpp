#include "simulation/rollback.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>
#include <tuple>

#include "core/communicator.hpp"
#include "simulation/checkpoint.hpp"
#include "simulation/resultsWriter.hpp"

namespace corpuscle::simulation {

using coupling::Scene;

namespace {
constexpr long goodStepsToRelax = 10;                    // past the time of a fault
constexpr double leastStep = 1e-7, leastAdvance = 1e-4;  // of a full step
constexpr long triesToLook = 200;                        // after which progress since the last rollback is checked
constexpr double mostSteps = 1e9;                        // of a run
constexpr auto patience = std::chrono::seconds(10);      // with ranks that have yet to reach the same failure
// What to do if this limit of the step keeps a run from advancing.
std::string cureOf(const sph::StepLimit& limit) {
    if (!limit.cure.empty()) return limit.cure;
    return "take a smaller step ('implicit.step' or 'safety') in system/numerics.yaml, or a finer mesh or spacing";
}
}  // namespace

Rollback::Rollback(const Case& input, Scene& scene, Time& time, Integrator& integrator, Schedule& schedule, Log& log)
    : Rollback(input, scene, time, integrator, &schedule, log) {}
Rollback::Rollback(const Case& input, Scene& scene, Time& time, Integrator& integrator, Log& log)
    : Rollback(input, scene, time, integrator, nullptr, log) {}

Rollback::Rollback(const Case& input, Scene& scene, Time& time, Integrator& integrator, Schedule* schedule, Log& log)
    : input_(input),
      scene_(scene),
      time_(time),
      integrator_(integrator),
      schedule_(schedule),
      log_(log),
      traits_(input.scheme().traits()),
      check_(input, scene),
      meeting_(MPI_COMM_NULL) {
    MPI_Comm_dup(scene.system->comm(), &meeting_);
    if (schedule_) schedule_->record().set("performance", "rollbacks", count_);
    full_ = input.scheme().fullStep(input.facts(), time.dt);
    furthest_.t = lookNear_.t = lookFar_.t = time.t;
    if (const double steps = time.left() / full_; !time.lastStep && steps > mostSteps)
        throw Failure(
            ExitCode::numerics,
            fmt::format("the run would take {:.2g} steps of {:.3g} s, the limit '{}' of the step: {}; or give "
                        "an earlier end, or -steps",
                        steps, full_, integrator.limits().binding().name, cureOf(integrator.limits().binding())));
}

Rollback::~Rollback() { MPI_Comm_free(&meeting_); }

// Half, a quarter ... of the step that failed first.
double Rollback::longest() const {
    return inRow_ > 0 ? std::ldexp(failed_, -static_cast<int>(inRow_)) : std::numeric_limits<double>::infinity();
}

bool Rollback::advance() {
    if (input_.numerics.rollbacks > 0 && (good_[0].step < 0 || time_.step >= good_[0].step + traits_.stepsPerKeptState))
        remember();
    if (const Fault stall = creeping()) end(stall, "", cureOf(integrator_.limits().binding()));
    const Fault fault = step();
    if (fault) {
        report(fault);
        return false;
    }
    if (inRow_ > 0 && time_.t > faultTime_ && ++goodSteps_ >= goodStepsToRelax) {
        --inRow_, goodSteps_ = 0;
        integrator_.shorten(longest(), inRow_ > 1);
    }
    return true;
}

// Makes a step; returns what is wrong after it, empty if nothing is.
Fault Rollback::step() {
    const schemes::Stepper& stepper = integrator_.stepper();
    const long before = stepper.tries();
    bool isEvent = false;
    try {
        integrator_.advance(time_, schedule_ ? schedule_->events(time_) : time_.ends());
        isEvent = integrator_.wasShortened();
        if (!isEvent) furthest_.tries += std::max(1L, stepper.tries() - before);
        furthest_.t = std::max(furthest_.t, time_.t);
    } catch (const Failure& failure) {
        if (failure.code() != ExitCode::numerics || !allFailed()) throw;
        furthest_.tries += std::max(1L, stepper.tries() - before);
        return {failure.what(), StateCheck::suspect(scene_)};
    }
    if (time_.step % traits_.stepsPerLook != 0 && !isEvent && time_.running()) return {};
    return check_.find(scene_, time_);
}

// If only some ranks have failed, the others wait within the step: a rollback is then impossible, and the failure is
// passed on and ends the run.
bool Rollback::allFailed() {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(meeting_, &request);
    const auto start = std::chrono::steady_clock::now();
    for (int met = 0; std::chrono::steady_clock::now() - start < patience;) {
        MPI_Test(&request, &met, MPI_STATUS_IGNORE);
        if (met) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

void Rollback::remember() {
    std::swap(good_[0], good_[1]);
    Good& good = good_[0];
    simulation::remember(good.state, input_, scene_, time_, {.integrator = integrator_.state(time_), .observers = {}});
    if (schedule_) good.schedule = schedule_->remember();
    good.t = time_.t, good.step = time_.step;
}

void Rollback::goBack(Good& good) {
    const RunState state = recall(good.state, input_, scene_, time_);
    integrator_.goBack(state.integrator, time_);
    integrator_.shorten(longest(), inRow_ > 1);
    time_.dt = std::min(time_.dt, longest());
    if (schedule_) schedule_->goBack(good.schedule, scene_, time_);
    check_.take(scene_);
    goodSteps_ = 0;
    lookNear_ = {furthest_.tries, time_.t};
}

void Rollback::report(const Fault& fault) {
    faultTime_ = inRow_ > 0 ? std::max(faultTime_, time_.t) : time_.t;
    if (inRow_ == 0) failed_ = integrator_.tried();
    const long most = input_.numerics.rollbacks;
    if (fault.isGeometric)
        end(fault, "a shorter step would not help", "place cells further apart, or end the run earlier");
    if (inRow_ < most) {
        ++inRow_, ++count_;
        if (schedule_) schedule_->record().set("performance", "rollbacks", count_);
        if (inRow_ > 2 && good_[1].step >= 0) std::swap(good_[0], good_[1]), good_[1].step = -1;
        log_.warning("{}. Back to step {}, t = {:.6g} s, and on with 1/{} of the step{}", fault.text, good_[0].step,
                     good_[0].t, 1L << inRow_, inRow_ > 1 && traits_.hasDampedSteps ? ", by backward Euler" : "");
        goBack(good_[0]);
        return;
    }
    end(fault, most > 0 ? fmt::format("{} rollbacks with steps down to 1/{} did not help", most, 1L << most) : "",
        fmt::format("take a smaller '{}' in system/numerics.yaml, or a finer mesh or spacing", traits_.stepKey));
}

void Rollback::end(const Fault& fault, const std::string& tried, const std::string& cure) {
    throw Failure(ExitCode::numerics,
                  fault.text + keepFault(fault) + (tried.empty() ? "" : ". " + tried) + ": " + cure);
}

std::string Rollback::keepFault(const Fault& fault) {
    if (!schedule_) return "";
    std::string where = "; its surroundings are in " + writeFault(input_, scene_, time_, fault.place);
    if (input_.numerics.rollbacks > 0) {
        goBack(good_[0]);
        schedule_->saveCheckpoint(scene_, time_);
        where += fmt::format(", and a checkpoint of the last good state, t = {:.6g} s, is written", time_.t);
    }
    schedule_->record().set("fault", "text", fault.text);
    schedule_->record().set("fault", "time_s", faultTime_);
    schedule_->record().set("fault", "place_m", std::vector<double>(fault.place.data(), fault.place.data() + 3));
    return where;
}

Fault Rollback::creeping() {
    const sph::StepLimit bound = integrator_.limits().binding();
    const auto because = [&](const std::string& what) {
        faultTime_ = time_.t;
        return Fault{
            fmt::format("step {}, t = {:.6g} s: {}. A full step is {:.3g} s; the limit '{}' holds it at {:.3g} s, "
                        "after {} rollback{} since the start",
                        time_.step, time_.t, what, full_, bound.name, bound.seconds, count_, count_ == 1 ? "" : "s"),
            StateCheck::suspect(scene_)};
    };
    if (time_.dt < leastStep * full_)
        return because(fmt::format("the step has fallen to {:.3g} s, and the run would never end", time_.dt));
    // Progress is checked since the last rollback and also over the whole run, so that a run does not go back and forth
    // for ever: over more steps than are needed to pass a fault from the earlier state with the shortest step.
    const long toPassFault = 4 * traits_.stepsPerKeptState << std::min(input_.numerics.rollbacks, 20L);
    for (const auto& [look, now, enough] : {std::tuple(&lookNear_, Progress{furthest_.tries, time_.t}, triesToLook),
                                            std::tuple(&lookFar_, furthest_, std::max(triesToLook, toPassFault))}) {
        const long tries = now.tries - look->tries;
        if (tries < enough) continue;
        const double gained = now.t - look->t;
        *look = now;
        if (gained < leastAdvance * full_ * static_cast<double>(tries))
            return because(
                fmt::format("{} tries have brought the run {:.3g} s further, and it would never end", tries, gained));
    }
    return {};
}

}  // namespace corpuscle::simulation
