// Complete states: everything that a run needs to continue as if it had never stopped (docs/simulation.md).
//
// Particles are saved rank by rank in memory order, with their positions at the last list build. The same number of
// ranks therefore rebuilds the same lists and continues bit for bit; another number of ranks distributes them anew.
#pragma once
#include <filesystem>

#include "core/time.hpp"
#include "coupling/scene.hpp"
#include "io/checkpointFile.hpp"
#include "io/memoryCheckpoint.hpp"
#include "simulation/integrator.hpp"

namespace corpuscle::simulation {

// The part of a state that is not in the scene.
struct RunState {
    Integrator::State integrator;
    std::vector<double> observers;
};

void writeCheckpoint(const Case& input, const coupling::Scene& scene, const Time& time, const RunState& state);

// Fills an empty scene; the case has passed compareSettings (restart.hpp). Collective.
RunState readCheckpoint(const std::filesystem::path& path, const Case& input, coupling::Scene& scene, Time& time);

// Save a state in memory and restore it to the scene of the same run, which may have advanced or diverged in between.
// Collective.
void remember(io::MemoryCheckpoint& memory, const Case& input, const coupling::Scene& scene, const Time& time,
              const RunState& state);
RunState recall(const io::MemoryCheckpoint& memory, const Case& input, coupling::Scene& scene, Time& time);

// The checkpoint that `startFrom` selects (latestTime, firstTime, or a time: the nearest before it); empty for the
// start from 0/. Warnings name checkpoints that were skipped.
std::filesystem::path chooseCheckpoint(const Case& input, const std::string& startFrom, MPI_Comm comm, Log& log);

}  // namespace corpuscle::simulation
