// One rank's view of a checkpoint file, without MPI: reading needs no coordination at this level, so a corrupt file
// cannot leave ranks waiting for each other. Opening a file verifies everything except the numbers in its datasets,
// which are verified as they are read. All functions throw Failure(ExitCode::io) naming file and dataset.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "io/checksum.hpp"
#include "io/contents.hpp"
#include "io/hdf5Handle.hpp"

namespace corpuscle::io {

class CheckpointAccess {
  public:
    explicit CheckpointAccess(const std::filesystem::path& path);

    struct Dataset {
        Handle id;
        std::string name;
        bool isDouble = false;
        hsize_t rows = 0, components = 0;
        std::uint64_t sum = 0;  // checksum of the whole dataset
    };
    Dataset open(const std::string& name) const;
    template <class T>
    void require(const Dataset& dataset, int components) const;

    // Rows [first, first + count) and their part of the checksum.
    template <class T>
    std::vector<T> slab(const Dataset& dataset, hsize_t first, hsize_t count, std::uint64_t& sum) const;
    // All rows, verified.
    template <class T>
    std::vector<T> whole(const Dataset& dataset) const;

    // First row and number of rows of a rank: those that it wrote if the file was written by `ranks` ranks, otherwise
    // an even share.
    std::pair<hsize_t, hsize_t> share(const Dataset& dataset, int rank, int ranks) const;

    // T is double, std::int64_t or std::string.
    template <class T>
    T attribute(const std::string& name) const;

    void verify() const;  // reads everything, in blocks

    const std::vector<std::string>& names() const { return names_; }  // datasets, sorted
    std::int64_t ranksWritten() const { return ranksWritten_; }
    Failure corrupt(const std::string& dataset) const;

  private:
    Dataset openFull(const std::string& fullName, const std::string& name) const;
    Contents contents() const;
    std::vector<std::string> namesBelow(const char* group) const;

    std::filesystem::path path_;
    QuietHdf5 quiet_;
    Handle file_;
    std::int64_t ranksWritten_ = 0;
    std::vector<std::string> names_, distributed_;
};

}  // namespace corpuscle::io
