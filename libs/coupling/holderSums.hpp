// Sums over the ranks that hold a cell, of numbers in rows: rows for each of its nodes, or one for the cell.
//
// Holders of a cell send each other what they have, and each adds it up in the order of the ranks: all of them find the
// same bits. A cell that one rank alone holds costs nothing. Rows to which a rank adds nothing are not sent.
#pragma once
#include <span>
#include <vector>

#include "coupling/cells.hpp"

namespace corpuscle::coupling {

class HolderSums {
  public:
    // For the cells as they are held now, in their order: rows(cell) of each. mine: of each row, whether this rank may
    // have something to add. Collective among holders.
    template <class Rows>
    void plan(const Cells& cells, MPI_Comm comm, Rows&& rows, std::span<const char> mine) {
        first_.assign(1, 0);
        for (const Cell& cell : cells) first_.push_back(first_.back() + static_cast<std::size_t>(rows(cell)));
        plan(cells, comm, mine);
    }

    // values: `width` numbers a row, this rank's part of the sums; afterwards the sums. Collective among holders.
    void addUp(std::span<double> values, std::size_t width);

  private:
    struct Neighbour {
        int rank;
        std::vector<std::size_t> cells, send, receive;  // shared with it; rows
        std::vector<char> mine, theirs;                 // of all rows of these cells
        std::vector<double> out, in;
    };
    void plan(const Cells& cells, MPI_Comm comm, std::span<const char> mine);

    MPI_Comm comm_ = MPI_COMM_NULL;
    std::vector<std::size_t> first_;     // row of each held cell, and one behind the last
    std::vector<Neighbour> neighbours_;  // ascending
    std::size_t below_ = 0;              // neighbours of lower rank
    std::vector<std::size_t> shared_;    // rows of cells that others hold too
    std::vector<char> isMine_;           // of these
    std::vector<double> own_;
};

}  // namespace corpuscle::coupling
