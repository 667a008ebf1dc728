// A folder for one test, the same on all ranks, empty at the start and removed at the end.
#pragma once
#include <mpi.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace corpuscle {

class TemporaryFolder {
  public:
    TemporaryFolder() {
        int initialised = 0;
        MPI_Initialized(&initialised);
        int process = ::getpid();
        if (initialised) {
            MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
            MPI_Bcast(&process, 1, MPI_INT, 0, MPI_COMM_WORLD);
        }
        static int counter = 0;
        path_ = std::filesystem::temp_directory_path() /
                ("corpuscle_test_" + std::to_string(process) + "_" + std::to_string(counter++));
        if (rank_ == 0) std::filesystem::create_directories(path_);
        if (initialised) MPI_Barrier(MPI_COMM_WORLD);
    }
    ~TemporaryFolder() {
        int initialised = 0;
        MPI_Initialized(&initialised);
        if (initialised) MPI_Barrier(MPI_COMM_WORLD);
        std::error_code ignored;
        if (rank_ == 0) std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    int rank_ = 0;
};

// The message of the Error that work() throws; empty if it throws none.
template <class Error, class Work>
std::string messageOf(Work&& work) {
    try {
        work();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

}  // namespace corpuscle
