// A closed cell keeps its volume exactly: of velocities and forces of its nodes the part along the gradient of its
// volume is taken away,
//     P = I - g g^T/(g.g),  g = dV/dx
// and what a finite step leaves is corrected along g. An open cell is left alone.
#pragma once
#include "coupling/nodeLayout.hpp"

namespace corpuscle::coupling {

class VolumeProjection {
  public:
    // g where nodes are now.
    void place(const Cells& cells, const NodeLayout& layout);
    void apply(NodeVectors& v) const;  // P v
    // Moves nodes to where their cells have the volume that they began with.
    static void restore(Cells& cells);

  private:
    NodeLayout layout_;
    NodeVectors gradient_;  // g of closed cells, 0 of open ones
};

}  // namespace corpuscle::coupling
