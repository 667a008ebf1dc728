// Checkpoints: checkpoints/<NNNNNN>.h5, one HDF5 file for all ranks, with everything a restart needs.
//
// A distributed dataset has rows x components numbers; each rank writes its own slab of rows, in the order of the
// ranks, and the rows of every rank are kept, so that the same number of ranks gets exactly its own slab back. Another
// number of ranks gets even slabs. A replicated dataset is the same on all ranks; rank 0's is written, every rank gets
// it back. Attributes are single values. Dataset names may hold slashes: "fluid/velocity".
//
// Every dataset carries a checksum (io/checksum.hpp) that is verified on each reading; attributes, names and shapes are
// covered by a checksum of the contents (io/contents.hpp), verified when a file is opened, HDF5's own structures by
// those of its file format 1.10. A file is written under a temporary name, brought to disk and renamed: a name that
// ends in .h5 is a complete checkpoint, whatever killed the program.
//
// All functions that take a communicator are collective; what fails on one rank throws Failure(ExitCode::io) on all.
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
    ~CheckpointWriter();  // without finish(): nothing remains
    CheckpointWriter(const CheckpointWriter&) = delete;
    CheckpointWriter& operator=(const CheckpointWriter&) = delete;

    // This rank's rows, row by row: values.size() is a multiple of components.
    void writeDistributed(const std::string& name, std::span<const double> values, int components = 1);
    void writeDistributed(const std::string& name, std::span<const std::int64_t> values, int components = 1);
    void writeReplicated(const std::string& name, std::span<const double> values);
    void writeReplicated(const std::string& name, std::span<const std::int64_t> values);

    // Rank 0's value counts. "time" [s] is what listCheckpoints and findCheckpoint go by.
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
    // Throws when the file is missing or is no checkpoint. A message about a corrupt file names the newest intact older
    // one.
    CheckpointReader(MPI_Comm comm, const std::filesystem::path& path);
    ~CheckpointReader();
    CheckpointReader(const CheckpointReader&) = delete;
    CheckpointReader& operator=(const CheckpointReader&) = delete;

    // T is double or std::int64_t. Throw when the dataset is missing (naming those there are), has another type or
    // number of components, or its checksum is wrong.
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

// checkpoints/<NNNNNN>.h5 with the first free number; makes the folder.
std::filesystem::path nextCheckpoint(MPI_Comm comm, const std::filesystem::path& caseDir);

// What is wrong with a checkpoint after reading all of it, or an empty text. Not collective.
std::string checkCheckpoint(const std::filesystem::path& path);

// The readable checkpoints of a case by number (the order in which they were written). Not collective, needs no MPI.
std::vector<CheckpointInfo> listCheckpoints(const std::filesystem::path& caseDir);

// The last one written that is intact, or an empty path where there is none at all. Those passed over, and leftovers of
// killed runs, are named in warnings. Throws where there are some and none is intact.
struct CheckpointSearch {
    std::filesystem::path path;
    std::vector<std::string> warnings;
};
CheckpointSearch latestCheckpoint(MPI_Comm comm, const std::filesystem::path& caseDir);

// A time that a user copies from a log or a table names the checkpoint from which it was rounded: log lines have five
// digits.
constexpr double checkpointSlack = 1e-4;  // of the time

// The one nearest to `time` where it is within checkpointSlack of it, else the nearest before; of equal times the last
// one written. Throws with the list of available times where all are later. Not collective.
CheckpointInfo findCheckpoint(const std::filesystem::path& caseDir, double time);

// Removes those later than `last` [s], or, where no time is given, all: those that cannot be read and leftovers of
// killed runs too. Returns how many. Not collective.
long removeCheckpoints(const std::filesystem::path& caseDir, std::optional<double> last);

// Removes all but the `keep` last ones (0: keeps all) and leftovers of killed runs. Call it after finish().
void keepCheckpoints(MPI_Comm comm, const std::filesystem::path& caseDir, int keep);

}  // namespace corpuscle::io
