#include "coupling/holderSums.hpp"

#include <algorithm>
#include <map>

namespace corpuscle::coupling {

namespace {
enum Tag { maskTag = 21, sumTag };
}  // namespace

void HolderSums::plan(const Cells& cells, MPI_Comm comm, std::span<const char> mine) {
    comm_ = comm;
    int self = 0;
    MPI_Comm_rank(comm, &self);
    std::map<int, Neighbour> byRank;
    shared_.clear(), isMine_.clear();
    for (std::size_t c = 0; c < cells.heldCount(); ++c) {
        if (cells[c].holders.size() < 2 || first_[c] == first_[c + 1]) continue;
        for (std::size_t row = first_[c]; row < first_[c + 1]; ++row)
            shared_.push_back(row), isMine_.push_back(mine[row]);
        for (const int r : cells[c].holders) {
            if (r == self) continue;
            Neighbour& neighbour = byRank[r];
            neighbour.rank = r;
            neighbour.cells.push_back(c);
            neighbour.mine.insert(neighbour.mine.end(), mine.begin() + static_cast<std::ptrdiff_t>(first_[c]),
                                  mine.begin() + static_cast<std::ptrdiff_t>(first_[c + 1]));
        }
    }
    neighbours_.clear();
    for (auto& [rank, neighbour] : byRank) neighbours_.push_back(std::move(neighbour));
    below_ = static_cast<std::size_t>(
        std::count_if(neighbours_.begin(), neighbours_.end(), [&](const Neighbour& n) { return n.rank < self; }));
    std::vector<MPI_Request> requests(2 * neighbours_.size());
    for (std::size_t k = 0; k < neighbours_.size(); ++k) {
        Neighbour& n = neighbours_[k];
        const int length = static_cast<int>(n.mine.size());
        n.theirs.resize(n.mine.size());
        MPI_Irecv(n.theirs.data(), length, MPI_CHAR, n.rank, maskTag, comm_, &requests[2 * k]);
        MPI_Isend(n.mine.data(), length, MPI_CHAR, n.rank, maskTag, comm_, &requests[2 * k + 1]);
    }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    for (Neighbour& n : neighbours_) {
        std::size_t k = 0;
        for (const std::size_t c : n.cells)
            for (std::size_t row = first_[c]; row < first_[c + 1]; ++row, ++k) {
                if (n.mine[k]) n.send.push_back(row);
                if (n.theirs[k]) n.receive.push_back(row);
            }
    }
}

void HolderSums::addUp(std::span<double> values, std::size_t width) {
    if (shared_.empty()) return;
    std::vector<MPI_Request> requests;
    requests.reserve(2 * neighbours_.size());
    for (Neighbour& n : neighbours_) {
        n.in.resize(width * n.receive.size()), n.out.resize(width * n.send.size());
        double* out = n.out.data();
        for (const std::size_t row : n.send) out = std::copy_n(values.data() + width * row, width, out);
        if (!n.in.empty())
            MPI_Irecv(n.in.data(), static_cast<int>(n.in.size()), MPI_DOUBLE, n.rank, sumTag, comm_,
                      &requests.emplace_back());
        if (!n.out.empty())
            MPI_Isend(n.out.data(), static_cast<int>(n.out.size()), MPI_DOUBLE, n.rank, sumTag, comm_,
                      &requests.emplace_back());
    }
    own_.resize(width * shared_.size());
    for (std::size_t k = 0; k < shared_.size(); ++k) {
        double* const row = values.data() + width * shared_[k];
        std::copy_n(row, width, own_.data() + width * k);
        std::fill_n(row, width, 0.0);
    }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    const auto add = [&](std::size_t row, const double* part) {
        for (std::size_t k = 0; k < width; ++k) values[width * row + k] += part[k];
    };
    const auto addFrom = [&](const Neighbour& n) {
        for (std::size_t k = 0; k < n.receive.size(); ++k) add(n.receive[k], n.in.data() + width * k);
    };
    for (std::size_t n = 0; n < below_; ++n) addFrom(neighbours_[n]);
    for (std::size_t k = 0; k < shared_.size(); ++k)
        if (isMine_[k]) add(shared_[k], own_.data() + width * k);
    for (std::size_t n = below_; n < neighbours_.size(); ++n) addFrom(neighbours_[n]);
}

}  // namespace corpuscle::coupling
