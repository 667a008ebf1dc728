// A mean along the membrane for nodes that are closer together than the particles of the fluid. Without it each of
// these nodes would constrain the fluid on its own: with edges finer than dx, a stiff membrane would suppress every
// motion of the fluid that is not smooth on their scale, and would act like a thicker one.
//
//     (M u)_m = sum_n M_mn u_n,   M_mn = A_n (1 - r)^2 (1 + 2 r) / sum of these,   r = d_mn/s < 1,  s = 1.2 dx
// over the nodes n that are connected to m by edges through nodes within s; A_n: area of the node; d_mn: the largest
// distance from m of a node on the path from m to n on which this is least: |x_n - x_m| unless the membrane is
// folded. There, a node on the other side of the fold thus joins the mean gradually as the path to it comes within
// reach: M is a continuous function of the positions. With all edges of length s or more, M is the identity. Two
// effects of the mean are compensated in nodeFluidMap.hpp: the mean position of the nodes is not that of m (`shift`),
// and the mean square of their distances (`square`) adds to that of the weights.
#pragma once
#include "coupling/nodeLayout.hpp"

namespace corpuscle::coupling {

class MembraneSmoothing {
  public:
    static constexpr double reachInSpacings = 1.2;

    explicit MembraneSmoothing(double spacing) : reach_(reachInSpacings * spacing) {}

    // Computes M at the present positions. areas: area vector of each node of the cells that this rank holds [m^2].
    void place(const Cells& cells, const NodeLayout& layout, const NodeVectors& areas);

    bool isIdentity() const { return members_.size() == shift_.size(); }
    void apply(NodeVectors& u) const;      // u = M u
    void transpose(NodeVectors& f) const;  // f = M^T f

    const Vec3& shift(std::size_t node) const { return shift_[node]; }  // x_m - sum M x_n [m]
    double square(std::size_t node) const { return square_[node]; }     // sum M |x_n - x_m|^2 [m^2]
    // For each node, whether one of the nodes in its mean is marked. marks: of all nodes.
    std::vector<char> reached(const std::vector<char>& marks) const;

  private:
    struct Member {
        std::size_t node;
        double weight;
    };
    void placeCell(const Cell& cell, std::size_t first, const NodeVectors& areas);

    double reach_;
    std::vector<std::size_t> first_;  // of each node in members_, and one behind the last
    std::vector<Member> members_;
    NodeVectors shift_;
    std::vector<double> square_;
};

}  // namespace corpuscle::coupling
