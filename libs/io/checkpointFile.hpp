// Checkpoints: checkpoints/<NNNNNN>.h5, one HDF5 file for all ranks, with everything a restart needs.
//
// A distributed dataset has rows x components numbers. Each rank writes its own slab of rows, in the order of the
// ranks, and the number of rows of each rank is stored, so that with the same number of ranks each gets exactly its own
// slab back. With another number of ranks the slabs are even. A replicated dataset is the same on all ranks; that of
// rank 0 is written, and every rank reads it back. Attributes are single values. Dataset names may hold slashes:
// "fluid/velocity".
//
// Every dataset carries a checksum (io/checksum.hpp) that is verified on each reading. Attributes, names and shapes are
// covered by a checksum of the contents (io/contents.hpp), verified when a file is opened; HDF5's own structures are
// covered by the checksums of its file format 1.10. A file is written under a temporary name, flushed to disk and
// renamed: a file whose name ends in .h5 is a complete checkpoint, however the program ended.
//
// All functions that take a communicator are collective; an error on one rank throws Failure(ExitCode::io) on all.
#pragma once
#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace corpuscle::io {

class CheckpointWriter {
  public:
    CheckpointWriter(MPI_Comm comm, const std::filesystem::path& path);
    ~CheckpointWriter();  // without finish(), no file remains
    CheckpointWriter(const CheckpointWriter&) = delete;
    CheckpointWriter& operator=(const CheckpointWriter&) = delete;

    // This rank's rows, row by row: values.size() is a multiple of components.
    void writeDistributed(const std::string& name, std::span<const double> values, int components = 1);
    void writeDistributed(const std::string& name, std::span<const std::int64_t> values, int components = 1);
    void writeReplicated(const std::string& name, std::span<const double> values);
    void writeReplicated(const std::string& name, std::span<const std::int64_t> values);

    // The value of rank 0 is written. listCheckpoints and findCheckpoint read the attribute "time" [s].
    void attribute(const std::string& name, double value);
    void attribute(const std::string& name, std::int64_t value);
    void attribute(const std::string& name, const std::string& value);

    void finish();  // closes, syncs to disk, renames

  private:
    struct File;
    std::unique_ptr<File> file_;
};

class CheckpointReader {
  public:
    // Throws when the file is missing or is not a checkpoint. The message about a corrupt file names the newest intact
    // checkpoint before it.
    CheckpointReader(MPI_Comm comm, const std::filesystem::path& path);
    ~CheckpointReader();
    CheckpointReader(const CheckpointReader&) = delete;
    CheckpointReader& operator=(const CheckpointReader&) = delete;

    // T is double or std::int64_t. Throw when the dataset is missing (the message lists the existing ones), has another
    // type or number of components, or its checksum is wrong.
    template <class T>
    std::vector<T> readDistributed(const std::string& name, int components = 1);
    template <class T>
    std::vector<T> readReplicated(const std::string& name);

    // T is double, std::int64_t or std::string.
    template <class T>
    T attribute(const std::string& name);

    bool has(const std::string& name) const;  // a dataset of that name
    bool sameRanks() const;                   // written by as many ranks as read it now

  private:
    struct File;
    std::unique_ptr<File> file_;
};

struct CheckpointInfo {
    std::filesystem::path path;
    int number = 0;   // NNNNNN
    double time = 0;  // s
};

// checkpoints/<NNNNNN>.h5 with the number after the last one; makes the folder.
std::filesystem::path nextCheckpoint(MPI_Comm comm, const std::filesystem::path& caseDir);

// Reads all of a checkpoint and returns what is wrong with it, or an empty text. Not collective.
std::string checkCheckpoint(const std::filesystem::path& path);

// The readable checkpoints of a case by number (the order in which they were written). Not collective, needs no MPI.
std::vector<CheckpointInfo> listCheckpoints(const std::filesystem::path& caseDir);

// The last intact checkpoint written, or an empty path where there is no checkpoint at all. `warnings` name the corrupt
// ones that were skipped and leftovers of killed runs. Throws where there are checkpoints but none is intact.
struct CheckpointSearch {
    std::filesystem::path path;
    std::vector<std::string> warnings;
};
CheckpointSearch latestCheckpoint(MPI_Comm comm, const std::filesystem::path& caseDir);

// Relative tolerance for a time that a user copies from a log or a table, rounded, to name a checkpoint: log lines have
// five digits.
constexpr double checkpointSlack = 1e-4;  // of the time

// The checkpoint nearest to `time` if it is within checkpointSlack of it, else the nearest one before; of equal times
// the last one written. Throws with the list of available times where all are later. Not collective.
CheckpointInfo findCheckpoint(const std::filesystem::path& caseDir, double time);

// Removes the checkpoints later than `last` [s] or, where no time is given, all of them, including those that cannot be
// read and leftovers of killed runs. Returns the number of checkpoints removed. Not collective.
long removeCheckpoints(const std::filesystem::path& caseDir, std::optional<double> last);

// Removes all checkpoints but the last `keep` (0: keeps all), and leftovers of killed runs. To be called after
// finish().
void keepCheckpoints(MPI_Comm comm, const std::filesystem::path& caseDir, int keep);

}  // namespace corpuscle::io
