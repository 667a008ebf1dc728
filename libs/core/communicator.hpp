// The ranks that run together: a thin view of an MPI communicator. A serial run is the same code with one rank.
//
// Every function but rank(), size(), isRoot() and handle() is collective: all ranks call it in the same order. Sums are
// taken in an order that depends on the number of ranks only, so the same number of ranks gives the same bits.
#pragma once
#include <mpi.h>

#include <span>
#include <string>
#include <vector>

namespace corpuscle {

class Communicator {
  public:
    explicit Communicator(MPI_Comm handle = MPI_COMM_WORLD);

    int rank() const { return rank_; }
    int size() const { return size_; }
    bool isRoot() const { return rank_ == 0; }
    MPI_Comm handle() const { return handle_; }

    void barrier() const;
    double sum(double value) const;
    double min(double value) const;
    double max(double value) const;
    long sum(long value) const;
    long min(long value) const;
    long max(long value) const;
    // Component by component; all ranks give the same length.
    std::vector<double> sum(std::vector<double> values) const;
    std::vector<double> min(std::vector<double> values) const;
    std::vector<double> max(std::vector<double> values) const;
    std::vector<long> sum(std::vector<long> values) const;
    // Sum and maximum as above, in place.
    void addUp(std::span<double> values) const;
    void takeLargest(std::span<double> values) const;
    bool allTrue(bool value) const;
    bool anyTrue(bool value) const;

    // The value of the root, on every rank.
    double broadcast(double value) const;
    long broadcast(long value) const;
    std::string broadcast(std::string text) const;

    // One entry for each rank, on every rank.
    std::vector<long> gatherAll(long value) const;
    std::vector<double> gatherAll(double value) const;
    // One text for each rank; empty on all ranks but the root.
    std::vector<std::string> gather(const std::string& text) const;

    // All-to-all exchange: forRank[r] is sent to rank r, this rank included; entry r of the result is what rank r sent
    // to this rank.
    std::vector<std::vector<double>> exchange(const std::vector<std::vector<double>>& forRank) const;
    std::vector<std::vector<int>> exchange(const std::vector<std::vector<int>>& forRank) const;

  private:
    MPI_Comm handle_;
    int rank_ = 0, size_ = 1;
};

}  // namespace corpuscle
