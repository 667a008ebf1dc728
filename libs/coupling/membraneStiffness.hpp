// Stiffness K = -df/dx and damping C of the membranes of the cells that a rank holds, cell by cell; also their forces.
#pragma once
#include "coupling/nodeLayout.hpp"
#include "membrane/blockStiffness.hpp"

namespace corpuscle::coupling {

class MembraneStiffness {
  public:
    // Computes K and C at the present positions of the nodes. Keeps a pointer to the cells, which must not move in
    // memory.
    void build(const Cells& cells, const NodeLayout& layout);

    void addStiffness(double factor, const NodeVectors& u, NodeVectors& f) const;  // f += factor K u
    void addDamping(const NodeVectors& u, NodeVectors& f) const;                   // f -= C u
    // A third of the trace of (time K + C) per node, over all cells of the scene [N s/m]. Collective.
    double meanResistance(double time, MPI_Comm comm) const;

    // f -= C u. The static functions need no `build`.
    static void addViscousForces(const Cells& cells, const NodeLayout& layout, const NodeVectors& u, NodeVectors& f);
    // Elastic forces with nodes displaced [N].
    static NodeVectors forceAt(const Cells& cells, const NodeLayout& layout, const NodeVectors& displacement);

  private:
    const Cells* cells_ = nullptr;
    NodeLayout layout_;
    std::vector<int> number_;                                    // number of the cell that each entry belongs to
    std::vector<membrane::BlockStiffness> stiffness_, damping_;  // of each held cell
};

}  // namespace corpuscle::coupling
