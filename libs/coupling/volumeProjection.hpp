// Conservation of the volume that membranes enclose, given the flux of fluid through their holes (holeFlux.hpp). A
// sheet is a whole cell, or a part of a torn one: its whole triangles as far as they are connected. The velocities of
// its nodes become
//
//     u_m = P S v - g H v/(g.g),   P = I - g g^T/(g.g),   so that   g.u_m + H v = 0
// symbol | meaning                                                                                           | unit
// S v    | velocities interpolated from the fluid (nodeFluidMap.hpp)                                         | m/s
// g      | flux through the whole triangles of the sheet per velocity of its nodes: a third of the area      | m^2
//        | vectors around each node; dV/dx of a whole cell
// H v    | flux of the fluid through caps over the holes of the sheet, outward; 0 for a whole cell           | m^3/s
// Sheet and caps close a surface: as much fluid flows through one as through the other, and none through the sheet,
// which moves with the fluid. The enclosed volume therefore changes by the flux through the caps relative to their own
// motion, and a sheet with a hole too small for the fluid keeps its volume. H v is linear in v, so that the forces of
// the nodes have the transpose,
//
//     f_fluid = S^T P f - H^T (g.f)/(g.g)
// The mean pressure -(g.f)/(g.g) that a sheet exerts is thus taken off the sheet and acts on the fluid at its caps.
//
// The remaining error of a finite step is corrected along g where a cell is whole. Cells with a border from the start,
// which enclose no volume, are left alone.
#pragma once
#include <span>
#include <vector>

#include "coupling/nodeLayout.hpp"

namespace corpuscle::coupling {

// Whole triangles of a torn cell that are connected, by at least a node.
struct TornSheet {
    std::size_t cell = 0;                // index of a held cell
    std::vector<std::size_t> nodes{};    // of the layout
    std::vector<std::vector<int>> rims;  // of its holes: nodes of the cell (membrane::Network::rims)
    double square = 0;                   // g.g [m^4]
};

class VolumeProjection {
  public:
    // Computes g at the present positions of the nodes.
    void place(const Cells& cells, const NodeLayout& layout);
    const std::vector<TornSheet>& torn() const { return torn_; }

    void apply(NodeVectors& v) const;  // P v
    // P v for whole cells and v - g (g.v + flux)/(g.g) for torn sheets; flux: H v of each of these [m^3/s].
    void apply(NodeVectors& v, std::span<const double> flux) const;
    // Replaces f by P f; returns -(g.f)/(g.g) of each torn sheet [Pa].
    std::vector<double> applyToForces(NodeVectors& f) const;
    // Moves nodes along g so that each closed cell has its initial volume.
    static void restore(Cells& cells);

  private:
    void placeTorn(const Cell& cell, std::size_t index);

    NodeLayout layout_;
    NodeVectors gradient_;         // g
    std::vector<char> isClosed_;   // of each cell
    std::vector<TornSheet> torn_;  // ordered by cells
};

}  // namespace corpuscle::coupling
