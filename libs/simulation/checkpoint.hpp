// Complete states: what a run needs to go on as if it had never stopped (docs/simulation.md).
//
// Particles are saved rank by rank in their order, with the positions of the last list build, so that the same number
// of ranks rebuilds the same lists and goes on bit for bit; another number of ranks spreads them anew.
#pragma once
#include <filesystem>

#include "core/time.hpp"
#include "coupling/scene.hpp"
#include "io/checkpointFile.hpp"
#include "io/memoryCheckpoint.hpp"
#include "simulation/integrator.hpp"

namespace corpuscle::simulation {

// What is not in the scene.
struct RunState {
    Integrator::State integrator;
    std::vector<double> observers;
};

void writeCheckpoint(const Case& input, const coupling::Scene& scene, const Time& time, const RunState& state);

// Fills an empty scene, of a case that compareSettings (restart.hpp) has let pass. Collective.
RunState readCheckpoint(const std::filesystem::path& path, const Case& input, coupling::Scene& scene, Time& time);

// The same to memory and back into the scene of this run, which may have gone on or diverged since. Collective.
void remember(io::MemoryCheckpoint& memory, const Case& input, const coupling::Scene& scene, const Time& time,
              const RunState& state);
RunState recall(const io::MemoryCheckpoint& memory, const Case& input, coupling::Scene& scene, Time& time);

// The checkpoint that `startFrom` (latestTime, firstTime, or the one nearest before a time) means; empty for the start
// in 0/. Warnings name what was passed over.
std::filesystem::path chooseCheckpoint(const Case& input, const std::string& startFrom, MPI_Comm comm, Log& log);

}  // namespace corpuscle::simulation
