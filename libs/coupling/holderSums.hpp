// Sums over the ranks that hold a cell, of numbers in rows: one row for each of its nodes, or one for the cell.
//
// The holders of a cell send each other their parts, and each adds them up in the order of the ranks, so that all get
// the same bits. A cell with a single holder or without rows costs nothing. Rows to which a rank adds nothing are not
// sent.
#pragma once
#include <span>
#include <vector>

#include "coupling/cells.hpp"

namespace corpuscle::coupling {

class HolderSums {
  public:
    // Plans the sums for the cells that the rank holds now, in their order. rows(cell): number of rows of a cell.
    // mine: for each row, whether this rank may have a part to add. Collective among the holders of cells with rows.
    template <class Rows>
    void plan(const Cells& cells, MPI_Comm comm, Rows&& rows, std::span<const char> mine) {
        first_.assign(1, 0);
        for (const Cell& cell : cells) first_.push_back(first_.back() + static_cast<std::size_t>(rows(cell)));
        plan(cells, comm, mine);
    }

    // values: `width` numbers in each row; on entry this rank's parts, on return the sums. Collective among holders.
    void addUp(std::span<double> values, std::size_t width);

  private:
    struct Neighbour {
        int rank;
        std::vector<std::size_t> cells, send, receive;  // indices of cells held by both; rows to send and to receive
        std::vector<char> mine, theirs;                 // marks of all rows of these cells
        std::vector<double> out, in;
    };
    void plan(const Cells& cells, MPI_Comm comm, std::span<const char> mine);

    MPI_Comm comm_ = MPI_COMM_NULL;
    std::vector<std::size_t> first_;     // first row of each held cell, and the number of all rows
    std::vector<Neighbour> neighbours_;  // in ascending order of ranks
    std::size_t below_ = 0;              // number of neighbours with a lower rank than this one
    std::vector<std::size_t> shared_;    // rows of cells that other ranks hold too
    std::vector<char> isMine_;           // marks of the shared rows
    std::vector<double> own_;            // this rank's parts of the shared rows
};

}  // namespace corpuscle::coupling
