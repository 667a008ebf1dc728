// The time loop's step, and what is done where it fails: back to the last good state, and on with shorter steps.
//
// A state is kept in memory every few steps, as a checkpoint would hold it (checkpoint.hpp), two of them, with what
// observers and results had seen by then. Where the integrator cannot make a step, or the state after it is refused
// (stateCheck.hpp), the run goes back to the later one with half the step, from the second time on by backward Euler
// where the step is implicit, and from the third time on to the earlier one. Ten good steps past the place of the fault
// take one of these back. When `rollbacks` of system/numerics.yaml in a row have not helped, the last good state is
// written as a checkpoint, the surroundings of the fault as streams `fault` and `fault_<cell>` of results/, and the run
// ends with exit code 3 and where, when and why. Rows and results of steps that are taken back are taken out of the
// files.
//
// A fault that lies in the geometry (Fault::isGeometric) is not tried again: no shorter step cures it. And a run never
// creeps: where the step falls below 1e-7 of that which the case has at its start (implicit: asks for), or the time
// comes forward by less than 1e-4 of it a step, over 200 steps since the last rollback or over as many as all rollbacks
// in a row may take, parts of steps and those taken back included, the run ends with exit code 3, the limit of the step
// that binds, and what to change.
// A run that would take more than 1e9 steps of its first length ends before the first, unless -steps is given.
//
// Cost: of the order of a hundredth of a step (docs/simulation.md).
#pragma once
#include "simulation/schedule.hpp"
#include "simulation/stateCheck.hpp"

namespace corpuscle::simulation {

class Rollback {
  public:
    // All of these must stay where they are; integrator and schedule have been started.
    Rollback(const Case& input, coupling::Scene& scene, Time& time, Integrator& integrator, Schedule& schedule,
             Log& log);
    // The same for a few steps of which nothing is written (checkCase); they end at the ends of the run alone.
    Rollback(const Case& input, coupling::Scene& scene, Time& time, Integrator& integrator, Log& log);
    ~Rollback();
    Rollback(const Rollback&) = delete;
    Rollback& operator=(const Rollback&) = delete;

    // One step. False where it failed and the run is back at an earlier time. Collective. Throws Failure(numerics) on
    // all ranks at the end.
    bool advance();

    long count() const { return count_; }  // of rollbacks since the start

  private:
    struct Good {
        io::MemoryCheckpoint state;
        Schedule::Memory schedule;
        double t = 0;
        long step = -1;  // none yet
    };
    void remember();
    Fault step();
    bool allFailed();
    void goBack(Good& good);
    void report(const Fault& fault);
    Fault creeping();  // why the run comes no further; none: it does
    [[noreturn]] void end(const Fault& fault, const std::string& tried, const std::string& cure);
    Rollback(const Case& input, coupling::Scene& scene, Time& time, Integrator& integrator, Schedule* schedule,
             Log& log);
    std::string keepFault(const Fault& fault);  // in files; what they are
    double longest() const;                     // step [s]

    const Case& input_;
    coupling::Scene& scene_;
    Time& time_;
    Integrator& integrator_;
    Schedule* schedule_;  // none: nothing is written
    Log& log_;
    schemes::Traits traits_;
    StateCheck check_;
    MPI_Comm meeting_;
    Good good_[2];  // the later one first
    long inRow_ = 0, goodSteps_ = 0, count_ = 0;
    double faultTime_ = 0, failed_ = 0;  // when; the first step of a row that failed [s]
    double full_ = 0;                    // step that the case has at its start, or asks for [s]
    struct Progress {
        long tries = 0;  // steps, parts of steps, and those taken back
        double t = 0;
    };
    Progress furthest_;            // t: of any step so far
    Progress lookNear_, lookFar_;  // as they were when progress was looked at last: since the last rollback, over all
};

}  // namespace corpuscle::simulation
