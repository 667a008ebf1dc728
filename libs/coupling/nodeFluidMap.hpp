// What nodes of membranes find of a field in the fluid around them, and how their forces go to that fluid: the same
// weights both ways.
//
//     S : u_m = sum_j [w_mj (1 - n n^T) + w'_mj n n^T] u_j,   n the membrane's normal at the node
//     w_mj = V_j W(r/R) (c0 + c.q + c2 q^2),   W Wendland C2,   q = d_j/R,  r = |d_j|,  d_j = x_j - x_m,  R = 2.5 dx
//     sum_j w_mj = 1,   sum_j w_mj q = 0,   sum_j w_mj q^2 = s along the membrane (w), s' across it (w')
// Constant and linear fields are found exactly. The second moments make up for the reach of the weights: those of W
// itself, 0.2, would leave a node behind the membrane, since the velocity bends there where the membrane pulls along
// it, and what the weights spread is weaker by as much (docs/coupling.md; tests/implicit/loadedSphere.cpp has the
// figures). Where sum_j |w_mj| > 4, as on one side of fluid alone, or fewer than 10 particles are near: c = 0, c2 = 0
// (Shepard).
//
// A rank has the entries of its own particles for the nodes of the cells that it holds. Sums over the particles of a
// node are added up among the holders of its cell (holderSums.hpp).
#pragma once
#include "coupling/holderSums.hpp"
#include "coupling/nodeLayout.hpp"
#include "particles/sharedParticles.hpp"

namespace corpuscle::coupling {

class NodeFluidMap {
  public:
    static constexpr double radiusInSpacings = 2.5, largestWeights = 4.0;
    static constexpr double momentAlong = -0.04, momentAcross = 0.04;  // s, s'

    explicit NodeFluidMap(double spacing) : radius_(radiusInSpacings * spacing) {}

    // Weights where particles and nodes are now; lists are up to date. volume: of each particle [m^3]. Collective.
    // Throws Failure(numerics), on all ranks, where a node has no fluid around it.
    void place(const Cells& cells, const NodeLayout& layout, const particles::ParticleSystem& system,
               const std::vector<double>& volume);
    // Weights of ghosts too, where `place` has just been. Collective.
    void placeOthers(const Cells& cells, const NodeLayout& layout, particles::ParticleSystem& system,
                     const particles::SharedParticles& shared, const std::vector<double>& volume);

    // S u, u of four numbers a particle. Collective among holders.
    template <class Real>
    NodeVectors interpolate(const Real* u);
    // force_j += (S^T f)_j, of four numbers a particle: of own particles, and of ghosts in their entries.
    void spread(const NodeVectors& f, particles::RealArray& force) const { spreadBy(own_, f, force); }
    void spreadToOthers(const NodeVectors& f, particles::RealArray& force) const { spreadBy(others_, f, force); }

    const std::vector<int>& touched() const { return own_.touched; }  // particles of this rank with weights
    // Those with weights for the nodes of one held cell.
    const std::vector<int>& touchedBy(std::size_t cell) const { return own_.touchedBy[cell]; }
    const std::vector<int>& touchedOthers() const { return others_.touched; }  // entries of ghosts

    long fallbacks() const { return fallbacks_; }  // nodes of the last place with Shepard's weights, for either reason
    long mostFallbacks() const { return mostFallbacks_; }  // of any

  private:
    struct Entry {
        int particle;
        double along, extra;  // w, w' - w
        Vec3 q;
    };
    struct Weights {
        std::vector<std::size_t> first;  // of each node in `entries`, and one behind the last
        std::vector<Entry> entries;
        std::vector<int> touched;
        std::vector<std::vector<int>> touchedBy;  // of each cell

        void clear() { first.assign(1, 0), entries.clear(), touched.clear(), touchedBy.clear(); }
        void findTouched(const NodeLayout& layout, std::size_t particles);
    };
    using Polynomial = Eigen::Matrix<double, 5, 1>;  // c0, c, c2
    void findEntries(const Cells& cells, const particles::ParticleSystem& system, const std::vector<double>& volume);
    void findWeights(const Cells& cells, const NodeLayout& layout, MPI_Comm comm);
    void spreadBy(const Weights& weights, const NodeVectors& f, particles::RealArray& force) const;

    double radius_;
    HolderSums sums_;
    Weights own_, others_;
    std::vector<Polynomial> along_, extra_;  // of each node
    NodeVectors normal_;                     // of each node; 0 where it has no area
    long fallbacks_ = 0, mostFallbacks_ = 0;
};

}  // namespace corpuscle::coupling
