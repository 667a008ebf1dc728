// How a run begins: from the state in 0/, or from a checkpoint.
#pragma once
#include "core/application.hpp"
#include "simulation/checkpoint.hpp"

namespace corpuscle::simulation {

// Time at the start of a run, with its end conditions.
Time startTime(const Application& app, const Case& input);
void setEnds(Time& time, const ControlSettings& control);
// Throws Failure(io) on all ranks if a file that the run will write cannot be written. Collective.
void requireOutput(const Application& app, const Case& input);

// The scene at the chosen start, and what the integrator and observers need to go on from a checkpoint.
struct StartingPoint {
    coupling::Scene scene;
    Time time;
    std::filesystem::path checkpoint;  // empty: from 0/
    RunState state;
    std::vector<std::string> notes;  // allowed changes of settings since the checkpoint
    // The checkpoint is at the end of the run already: there is nothing to run, and the user has been told.
    bool isFinished = false;
};
// Chooses the start and makes its scene. Takes the lock of the case, unless it is a dry run. Collective.
StartingPoint prepare(Application& app, const Case& input);

// Forces and first step at the start, or the continuation of a checkpoint.
void startIntegrator(const StartingPoint& from, Integrator& integrator, Time& time);

}  // namespace corpuscle::simulation
