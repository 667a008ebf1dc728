// Makes the steps of the time loop; if a step fails, returns to the last good state and continues with shorter steps.
//
// Two states are kept in memory, in the form of a checkpoint (checkpoint.hpp), together with the state of observers and
// results at that time; every few steps a new one replaces the older. If the integrator cannot make a step, or the
// state after it is rejected (stateCheck.hpp), the run returns to the later state with half the step; from the second
// failure in a row on the step is made by backward Euler if it is implicit, and from the third on the run returns to
// the earlier state. Ten good steps past the time of the fault undo one of these measures. When `rollbacks` of
// system/numerics.yaml in a row have not helped, the last good state is written as a checkpoint, the surroundings of
// the fault are written as streams `fault` and `fault_<type>` of results/, and the run ends with exit code 3 and a
// message that says where, when and why. Rows and results of steps that were rolled back are removed from the files.
//
// After a geometric fault (Fault::isGeometric) the run ends at once: no shorter step cures it. A run that hardly
// advances ends too, with exit code 3, the binding limit of the step, and what to change: if the step falls below 1e-7
// of a full step (the first step of the run; implicit: the step that the case asks for), or if the time advances by
// less than 1e-4 of a full step per step, over 200 steps since the last rollback or over as many as all rollbacks in a
// row may take. Parts of steps and steps that were rolled back count as steps.
// A run that would take more than 1e9 full steps ends before the first, unless -steps is given.
//
// Cost: of the order of a hundredth of the time of a step (docs/simulation.md).
#pragma once
#include "simulation/schedule.hpp"
#include "simulation/stateCheck.hpp"

namespace corpuscle::simulation {

class Rollback {
  public:
    // Refers to all arguments, which must not be moved in memory; integrator and schedule have been started.
    Rollback(const Case& input, coupling::Scene& scene, Time& time, Integrator& integrator, Schedule& schedule,
             Log& log);
    // The same for a few steps without output (checkCase); only the ends of the run shorten a step.
    Rollback(const Case& input, coupling::Scene& scene, Time& time, Integrator& integrator, Log& log);
    ~Rollback();
    Rollback(const Rollback&) = delete;
    Rollback& operator=(const Rollback&) = delete;

    // Makes one step; returns false if it failed and the run was rolled back to an earlier time. Throws
    // Failure(numerics) on all ranks if the run has to end. Collective.
    bool advance();

    // Keeps no state from before this moment: its observers and intervals were others (liveSettings.hpp).
    void forget() { good_[0].step = good_[1].step = -1; }

    long count() const { return count_; }  // number of rollbacks since the start

  private:
    struct Good {
        io::MemoryCheckpoint state;
        Schedule::Memory schedule;
        double t = 0;
        long step = -1;  // -1: none kept yet
    };
    void remember();
    Fault step();
    bool allFailed();
    void goBack(Good& good);
    void report(const Fault& fault);
    Fault creeping();  // why the run hardly advances; empty if it does advance
    [[noreturn]] void end(const Fault& fault, const std::string& tried, const std::string& cure);
    Rollback(const Case& input, coupling::Scene& scene, Time& time, Integrator& integrator, Schedule* schedule,
             Log& log);
    std::string keepFault(const Fault& fault);  // writes files about the fault; returns a text that names them
    double longest() const;                     // step that is allowed after rollbacks [s]

    const Case& input_;
    coupling::Scene& scene_;
    Time& time_;
    Integrator& integrator_;
    Schedule* schedule_;  // null: nothing is written
    Log& log_;
    schemes::Traits traits_;
    StateCheck check_;
    MPI_Comm meeting_;
    Good good_[2];  // the later one first
    long inRow_ = 0, goodSteps_ = 0, count_ = 0;
    double faultTime_ = 0, failed_ = 0;  // time of the fault; length of the first failed step in a row [s]
    double full_ = 0;                    // length of a full step: the first one, or what the case asks for [s]
    struct Progress {
        long tries = 0;  // steps, parts of steps, and steps rolled back
        double t = 0;
    };
    Progress furthest_;            // all tries so far, and the latest time reached
    Progress lookNear_, lookFar_;  // at the last check of progress: since the last rollback, and over the whole run
};

}  // namespace corpuscle::simulation
