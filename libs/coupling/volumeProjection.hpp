// Conservation of the volume of closed cells: the component along the gradient of the volume is removed from the
// velocities and forces of the nodes,
//     P = I - g g^T/(g.g),  g = dV/dx
// and the remaining error of a finite step is corrected along g. Open cells are left alone.
#pragma once
#include "coupling/nodeLayout.hpp"

namespace corpuscle::coupling {

class VolumeProjection {
  public:
    // Computes g at the present positions of the nodes.
    void place(const Cells& cells, const NodeLayout& layout);
    void apply(NodeVectors& v) const;  // P v
    // Moves nodes along g so that each closed cell has its initial volume.
    static void restore(Cells& cells);

  private:
    NodeLayout layout_;
    NodeVectors gradient_;  // g of closed cells, 0 of open ones
};

}  // namespace corpuscle::coupling
