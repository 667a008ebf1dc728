// Starts MPI around the tests of one executable. The root prints the report; other ranks print only their own failures,
// and a failure on any rank fails the program.
#include <gtest/gtest.h>
#include <mpi.h>

#include <cstdio>

#include "core/startMpi.hpp"

namespace {

class FailuresOfRank : public testing::EmptyTestEventListener {
  public:
    explicit FailuresOfRank(int rank) : rank_(rank) {}

  private:
    void OnTestPartResult(const testing::TestPartResult& result) override {
        if (result.failed())
            std::printf("[rank %d] %s:%d: %s\n", rank_, result.file_name() ? result.file_name() : "",
                        result.line_number(), result.message());
    }
    int rank_;
};

}  // namespace

int main(int argc, char** argv) {
    corpuscle::startMpi(argc, argv);
    testing::InitGoogleTest(&argc, argv);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank != 0) {
        auto& listeners = testing::UnitTest::GetInstance()->listeners();
        delete listeners.Release(listeners.default_result_printer());
        listeners.Append(new FailuresOfRank(rank));
    }
    int failed = RUN_ALL_TESTS();
    MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    MPI_Finalize();
    return failed;
}
