// Search trees over the triangles of held cells, kept while they are held and brought up to date when asked for.
#pragma once
#include <map>
#include <memory>

#include "coupling/cells.hpp"
#include "geometry/triangleTree.hpp"

namespace corpuscle::coupling {

class SurfaceTrees {
  public:
    explicit SurfaceTrees(double reach) : reach_(reach) {}  // of their questions [m]

    // Where its nodes are now. The tree stays where it is until the cell is forgotten.
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
