// What an earlier run of the case has left after the time at which a new run starts. It belongs to another history: if
// it stayed, the new run would later be continued from those checkpoints and shown together with those results.
#pragma once
#include <mpi.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace corpuscle::io {

struct ClearedOutput {
    std::vector<std::string> streams;  // streams of results/ that have lost entries
    long times = 0;                    // number of these entries
    long checkpoints = 0;
    bool empty() const { return times == 0 && checkpoints == 0; }
    std::string text() const;  // "12 times of fluid, rbc in results/ and 2 checkpoints"
};

// Collective. Removes what lies after `start` [s] by more than 1e-8 of it, or everything where there is no start (a run
// from 0/): the entries and their files of every stream of results/, including streams of cells that the case no longer
// has, and checkpoints; also the temporary files of a run that was killed while it wrote one of the files above, or
// run.json and used.yaml. Files that no run of Corpuscle wrote stay. For tables see csvSeries.hpp.
ClearedOutput clearAfter(MPI_Comm comm, const std::filesystem::path& caseDir, std::optional<double> start);

}  // namespace corpuscle::io
