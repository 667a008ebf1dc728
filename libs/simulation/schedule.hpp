// What happens after each step: observers, results, checkpoints, progress, requests to stop. Nothing here changes the
// state.
#pragma once
#include <map>
#include <memory>

#include "core/application.hpp"
#include "core/runRecord.hpp"
#include "core/wallClock.hpp"
#include "coupling/scene.hpp"
#include "observers/observers.hpp"
#include "simulation/resultsWriter.hpp"
#include "simulation/startingPoint.hpp"

namespace corpuscle::simulation {

class Schedule {
  public:
    Schedule(Application& app, const Case& input, const StartingPoint& from, const Integrator& integrator);
    // If the run ends by an error, reports the checkpoint from which it can continue.
    ~Schedule();
    // For -dry-run: reports groups, limits and the number of particles; writes nothing.
    ExitCode dryRun(const coupling::Scene& scene, const Time& time);
    // Writes the head of the log, used.yaml, run.json, and what is due before the first step. Changes files of the case
    // for the first time: it begins by removing what an earlier run wrote after the start.
    void begin(const coupling::Scene& scene, const Time& time);
    // Whether the run is to end early: by request, or at the first broken bond if the case says so. Collective.
    bool stopRequested(const coupling::Scene& scene, const Time& time);
    // Whether the ranks compared their clocks at this step, which they do about once per second.
    bool isMomentToLook(const Time& time) const { return stop_.comparedAt(time.step); }
    // Goes on with the observers, intervals and ends of an edited case, of which `changes` tells the user. If this
    // throws, nothing has changed. Collective.
    void change(const Case& edited, const std::vector<std::string>& changes, const coupling::Scene& scene,
                const Time& time);
    void afterStep(const coupling::Scene& scene, const Time& time);
    // Where steps have to end: at the ends of the run, and at the times of results and observers.
    std::vector<Event> events(const Time& time) const;

    // What is kept for a rollback (rollback.hpp), so that observers look again and results are written again after it.
    // Collective.
    struct Memory {
        observers::Observers::Memory observers;
        Ticker results;
        long guardMoves = 0, brokenBonds = 0;
    };
    Memory remember() const;
    void goBack(const Memory& memory, const coupling::Scene& scene, const Time& time);
    // Writes a checkpoint of the state in the scene.
    void saveCheckpoint(const coupling::Scene& scene, const Time& time);
    RunRecord& record() { return record_; }
    // Writes the last checkpoint and the final figures; returns the exit code.
    ExitCode end(const coupling::Scene& scene, const Time& time);

  private:
    void describe();
    void reportGuard(const coupling::Scene& scene, const Time& time);
    void recordProgress(const Time& time);
    void reportRupture(const coupling::Scene& scene, const Time& time);
    void reportObservers(const coupling::Scene& scene, const Time& time);
    double particleSteps(const Time& time) const;

    Application& app_;
    const Case& input_;
    const Integrator& integrator_;
    Time start_;
    bool isContinued_;
    std::vector<std::string> notes_, edits_;
    observers::Observers observers_;
    ResultsWriter results_;
    WallTicker checkpoints_;
    StopControl stop_;
    Progress progress_;
    std::shared_ptr<RunRecord> kept_;  // shared: outlives this object if an error ends the run
    RunRecord& record_;
    std::chrono::steady_clock::time_point began_;
    double processorBegan_;  // processor time of this rank at the start [s]
    long particles_ = 0, guardMoves_ = 0, brokenBonds_ = 0;
    double smallestDt_ = 0, largestDt_ = 0;
    bool begun_ = false;
    std::string binding_;                         // the limit that sets the length of the next step
    std::map<std::string, long> stepsLimitedBy_;  // number of steps by the limit that set their length
    std::string stopReason_;
    std::chrono::steady_clock::time_point told_ = std::chrono::steady_clock::now();
    long toldStep_ = 0;
};

Usage solverUsage(const std::string& name);

}  // namespace corpuscle::simulation
