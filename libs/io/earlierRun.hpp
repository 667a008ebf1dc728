// What an earlier run of the case has left after the time at which a new one starts: it belongs to another history, and
// a run that began beside it would be continued from its checkpoints and shown with its results.
#pragma once
#include <mpi.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace corpuscle::io {

struct ClearedOutput {
    std::vector<std::string> streams;  // of results/ that have lost something
    long times = 0;                    // entries of them
    long checkpoints = 0;
    bool empty() const { return times == 0 && checkpoints == 0; }
    std::string text() const;  // "12 times of fluid, rbc in results/ and 2 checkpoints"
};

// Collective. Removes what lies after `start` [s] by more than 1e-8 of it, or everything where there is no start (a run
// from 0/): of every stream of results/, those of cells that the case no longer has included, the entries and their
// files; and checkpoints. Files that no run of Corpuscle wrote stay. Of tables see csvSeries.hpp.
ClearedOutput clearAfter(MPI_Comm comm, const std::filesystem::path& caseDir, std::optional<double> start);

}  // namespace corpuscle::io
