// Search trees over the whole triangles of held cells: kept while a cell is held and no triangle breaks, updated when
// asked for.
#pragma once
#include <map>
#include <memory>
#include <vector>

#include "coupling/cells.hpp"
#include "geometry/triangleTree.hpp"

namespace corpuscle::coupling {

class SurfaceTrees {
  public:
    explicit SurfaceTrees(double reach) : reach_(reach) {}  // largest distance that is searched [m]

    // The tree of a cell at the present positions of its nodes. Its triangles are the whole ones, in the order of
    // Network::wholeTriangles(), of which there must be some. The reference is valid until keepHeld drops the cell.
    geometry::TriangleTree& of(const Cell& cell) {
        const membrane::Membrane& m = cell.membrane;
        Entry& entry = trees_[m.cell];
        const std::vector<int>& whole = m.network().wholeTriangles();
        if (!entry.tree || entry.whole.size() != whole.size() || (m.network().isOpen() && entry.whole != whole)) {
            entry.whole = whole;
            geometry::TriangleMesh mesh{m.position, {}};
            for (const int t : whole) mesh.triangles.push_back(m.network().triangles()[static_cast<std::size_t>(t)]);
            entry.tree = std::make_unique<geometry::TriangleTree>(mesh, reach_);
        } else {
            entry.tree->update(m.position);
        }
        return *entry.tree;
    }
    void keepHeld(const Cells& cells) {
        std::erase_if(trees_, [&](const auto& entry) { return !cells.find(entry.first); });
    }

  private:
    struct Entry {
        std::unique_ptr<geometry::TriangleTree> tree;
        std::vector<int> whole;  // numbers of its triangles
    };
    double reach_;
    std::map<int, Entry> trees_;  // by the number of the cell
};

}  // namespace corpuscle::coupling
