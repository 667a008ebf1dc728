// The time loop's step, and what is done where it fails: back to the last good state, and on with shorter steps.
//
// A state is kept in memory every few steps, as a checkpoint would hold it (checkpoint.hpp), two of them, with what observers and results
// had seen by then. Where the integrator cannot make a step, or the state after it is refused (watch.hpp), the run goes back to the later
// one with half the step, from the second time on by backward Euler where the step is implicit, and from the third time on to the earlier
// one. Ten good steps past the place of the fault take one of these back. When `retreats` of system/numerics.yaml in a row have not helped, the last
// good state is written as a checkpoint, the surroundings of the fault as streams `fault` and `fault_<cell>` of results/, and the run ends with exit
// code 3 and where, when and why. Rows and results of steps that are taken back are taken out of the files.
//
// Cost: of the order of a hundredth of a step (docs/simulation.md).
#pragma once
#include "simulation/schedule.hpp"
#include "simulation/watch.hpp"

namespace corpuscle::simulation {

class Retreat {
  public:
    // All of these must stay where they are; integrator and schedule have been started.
    Retreat(const Case& input, coupling::Scene& scene, Time& time, Integrator& integrator, Schedule& schedule,
            Log& log);
    ~Retreat();
    Retreat(const Retreat&) = delete;
    Retreat& operator=(const Retreat&) = delete;

    // One step. False where it failed and the run is back at an earlier time. Collective. Throws Failure(numerics) on all ranks at the end.
    bool advance();

    long count() const { return count_; }  // of retreats since the start

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
    void writeSurroundings(const Fault& fault);
    double longest() const;  // step [s]

    const Case& input_;
    coupling::Scene& scene_;
    Time& time_;
    Integrator& integrator_;
    Schedule& schedule_;
    Log& log_;
    Watch watch_;
    MPI_Comm meeting_;
    Good good_[2];  // the later one first
    long inRow_ = 0, goodSteps_ = 0, count_ = 0;
    double faultTime_ = 0, failed_ = 0, tried_ = 0;  // when; the first step of a row that failed, the last one made [s]
};

}  // namespace corpuscle::simulation
