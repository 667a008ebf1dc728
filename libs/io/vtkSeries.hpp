// A stream of results in time, as ParaView reads it:
//
//     results/<stream>.pvd                                    times and files, rewritten atomically as a whole
//                                                             with every entry
//     results/<stream>/<stream>_NNNNNN.pvtp                   one time
//     results/<stream>/<stream>_NNNNNN/<stream>_NNNNNN_R.vtp  the piece of rank R
//
// Field data of every piece: TimeValue [s], strain. A file that a .pvd names is always complete. Nothing in the folder
// changes before the first write, which removes entries at or after the start time, left by an earlier run that went
// further.
#pragma once
#include <mpi.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/polyData.hpp"

namespace corpuscle::io {

struct SeriesEntry {
    double time;                 // s
    std::filesystem::path file;  // the .pvtp (or .vtp), reachable from the current directory
};

// Whether results/ has a stream of this name that belongs to no cell and no body: fluid, walls, bodies, holes, and the
// streams that a failed run leaves, fault and fault_<cell>.
bool isReservedStream(std::string_view name);

// The entries of a .pvd in their order. Throws Failure(ExitCode::io) when it is missing or is not a .pvd.
std::vector<SeriesEntry> readPvd(const std::filesystem::path& path);

// Writes a new .pvd, atomically. The files of its entries lie in the folder of the same name.
void writePvd(const std::filesystem::path& path, const std::vector<SeriesEntry>& entries);

class VtkSeries {
  public:
    // keep: number of last times to keep, 0 for all. startTime: the earliest that this run may write [s].
    VtkSeries(MPI_Comm comm, const std::filesystem::path& caseDir, std::string stream, int keep, double startTime);

    // Collective: every rank gives its piece, with the same array names. Without `strain`, the files have none. Throws
    // Failure(ExitCode::io) on all ranks.
    void write(double time, std::optional<double> strain, const PolyData& piece);

    // Collective. Removes what an earlier run that went further left, as the first write does: for a stream that has
    // nothing to write yet.
    void start();
    // Collective. At a rollback, removes what this run has written after `time`, to write it anew.
    void goBack(double time);
    // Another number of times to keep, from the next write on.
    void keep(int number) { keep_ = number; }

  private:
    void keepBefore(double limit);
    Cells agreeOnCells(const PolyData& piece) const;
    void writeIndex() const;
    void removeFiles(const SeriesEntry& entry) const;
    std::string stepName(int number) const;

    MPI_Comm comm_;
    int rank_ = 0, size_ = 1;
    std::filesystem::path results_;
    std::string stream_;
    int keep_;
    double startTime_;
    bool started_ = false;
    int number_ = 0;                    // of the next entry
    std::vector<SeriesEntry> entries_;  // on rank 0
};

}  // namespace corpuscle::io
