// How the membranes of the cells that a rank holds resist: stiffness K = -df/dx and damping C of their nodes, cell by
// cell, and the forces themselves.
#pragma once
#include "coupling/nodeLayout.hpp"
#include "membrane/blockStiffness.hpp"

namespace corpuscle::coupling {

class MembraneStiffness {
  public:
    // Of these cells, where their nodes are now. The cells must stay where they are.
    void build(const Cells& cells, const NodeLayout& layout);

    void addStiffness(double factor, const NodeVectors& u, NodeVectors& f) const;  // f += factor K u
    void addDamping(const NodeVectors& u, NodeVectors& f) const;                   // f -= C u
    // A third of the trace of (time K + C) per node, of all cells of the scene [N s/m]. Collective.
    double meanResistance(double time, MPI_Comm comm) const;

    // Without build. f -= C u.
    static void addViscousForces(const Cells& cells, const NodeLayout& layout, const NodeVectors& u, NodeVectors& f);
    // Of the elasticity, nodes displaced [N].
    static NodeVectors forceAt(const Cells& cells, const NodeLayout& layout, const NodeVectors& displacement);

  private:
    const Cells* cells_ = nullptr;
    NodeLayout layout_;
    std::vector<int> number_;                                    // of the cell that each of these is of
    std::vector<membrane::BlockStiffness> stiffness_, damping_;  // of each held cell
};

}  // namespace corpuscle::coupling
