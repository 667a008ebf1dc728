// Search trees over the triangles of held cells: kept while a cell is held, updated when asked for.
#pragma once
#include <map>
#include <memory>

#include "coupling/cells.hpp"
#include "geometry/triangleTree.hpp"

namespace corpuscle::coupling {

class SurfaceTrees {
  public:
    explicit SurfaceTrees(double reach) : reach_(reach) {}  // largest distance that is searched [m]

    // The tree of a cell at the present positions of its nodes. The reference is valid until keepHeld drops the cell.
    geometry::TriangleTree& of(const Cell& cell) {
        const membrane::Membrane& m = cell.membrane;
        std::unique_ptr<geometry::TriangleTree>& tree = trees_[m.cell];
        if (!tree)
            tree = std::make_unique<geometry::TriangleTree>(geometry::TriangleMesh{m.position, m.network().triangles()},
                                                            reach_);
        else
            tree->update(m.position);
        return *tree;
    }
    void keepHeld(const Cells& cells) {
        std::erase_if(trees_, [&](const auto& entry) { return !cells.find(entry.first); });
    }

  private:
    double reach_;
    std::map<int, std::unique_ptr<geometry::TriangleTree>> trees_;  // by the number of the cell
};

}  // namespace corpuscle::coupling
