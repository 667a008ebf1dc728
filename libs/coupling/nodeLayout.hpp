// Layout of a vector with one entry for each node of the cells that a rank holds, cell after cell.
#pragma once
#include <span>
#include <vector>

#include "coupling/cells.hpp"

namespace corpuscle::coupling {

using NodeVectors = std::vector<Vec3>;  // one for each node of the cells that the rank holds, cell after cell

inline NodeVectors positionsOf(const Cells& cells) {  // m
    NodeVectors x;
    for (const Cell& cell : cells) x.insert(x.end(), cell.membrane.position.begin(), cell.membrane.position.end());
    return x;
}

class NodeLayout {
  public:
    NodeLayout() = default;
    explicit NodeLayout(const Cells& cells) {
        for (const Cell& cell : cells) first_.push_back(first_.back() + static_cast<std::size_t>(cell.nodeCount()));
    }
    std::size_t cells() const { return first_.size() - 1; }
    std::size_t nodes() const { return first_.back(); }
    std::size_t first(std::size_t cell) const { return first_[cell]; }
    std::size_t last(std::size_t cell) const { return first_[cell + 1]; }  // one past the last node

    std::span<const Vec3> of(std::size_t cell, const NodeVectors& all) const {
        return {all.data() + first(cell), last(cell) - first(cell)};
    }
    std::span<Vec3> of(std::size_t cell, NodeVectors& all) const {
        return {all.data() + first(cell), last(cell) - first(cell)};
    }

    // f(node) for the nodes of the cells that `rank` owns; over all ranks, this visits each node of the scene once.
    template <class F>
    void forOwned(const Cells& cells, int rank, F&& f) const {
        for (std::size_t c = 0; c < this->cells(); ++c)
            if (cells[c].isOwnedBy(rank))
                for (std::size_t m = first(c); m < last(c); ++m) f(m);
    }
    // Sum of value(node) over the same nodes: the rank's part of a sum over all nodes of the scene.
    template <class F>
    double sumOverOwned(const Cells& cells, int rank, F&& value) const {
        double sum = 0;
        forOwned(cells, rank, [&](std::size_t m) { sum += value(m); });
        return sum;
    }

  private:
    std::vector<std::size_t> first_{0};
};

}  // namespace corpuscle::coupling
