// Immersed coupling: fluid fills space through the membrane; a node has no fluid of its own. It moves with the velocity
// that it finds in the fluid around it, and its force goes to that fluid with the same weights:
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
// A closed cell keeps its volume exactly: of velocities and forces the part along the gradient of its volume is taken
// away,
//     P = I - g g^T/(g.g),  g = dV/dx;     u_m = P S u,   f_fluid = S^T P f_m
// so that power is neither made nor lost, and what the finite step leaves is corrected along g (restoreVolume). P ends
// when a cell opens. The stiffness that the fluid feels is S^T P K P S, symmetric and positive semi-definite as K is.
//
// All ranks hold all cells and compute the same; each knows the weights of its own particles, and sums over nodes are
// added up. Whoever needs forces on particles of others that the rank knows (particles/sharedParticles.hpp) asks for
// their weights as well.
#pragma once
#include <array>

#include "coupling/cell.hpp"
#include "membrane/blockStiffness.hpp"
#include "particles/sharedParticles.hpp"

namespace corpuscle::coupling {

class Immersed {
  public:
    using Vectors = std::vector<Vec3>;  // one of every node, cell after cell
    static constexpr double radiusInSpacings = 2.5, largestWeights = 4.0;
    static constexpr double momentAlong = -0.04, momentAcross = 0.04;  // s, s'

    Immersed(std::vector<Cell>& cells, double spacing);

    std::vector<Cell>& cells() { return cells_; }
    void move(double seconds);  // nodes along their velocities
    Vectors velocities() const;
    void setVelocities(const Vectors& velocities);
    void restoreVolume();

    // Weights of the particles and forces of the membranes, where particles and nodes are now. volume: of each particle
    // [m^3]. Collective. Throws Failure(numerics), on all ranks, where a node has no fluid around it.
    void place(const particles::ParticleSystem& system, const std::vector<double>& volume);
    // The same with the stiffness of the membranes.
    void build(const particles::ParticleSystem& system, const std::vector<double>& volume);

    // Weights of others' particles too, where `place` has just been. Collective.
    void placeOthers(particles::ParticleSystem& system, const particles::SharedParticles& shared,
                     const std::vector<double>& volume);

    // P S u, u of four numbers a particle. Collective.
    template <class Real>
    Vectors interpolate(const Real* u) const;
    Vectors force() const;                                                 // of the membranes [N]
    void addStiffness(double factor, const Vectors& u, Vectors& f) const;  // f += factor K u
    void addDamping(const Vectors& u, Vectors& f) const;                   // f -= C u
    void addResistance(double time, const Vectors& u, Vectors& f) const;   // f -= (time K + C) u
    double meanResistance(double time) const;  // a third of the trace of (time K + C), per node [N s/m]
    bool isViscous() const;
    void addViscousForces(const Vectors& u, Vectors& f) const;  // f -= C u, without build
    Vectors forceAt(const Vectors& displacement) const;         // of the membranes' elasticity, nodes displaced [N]
    // force_j += (S^T P f)_j, of four numbers a particle.
    void spread(Vectors f, particles::RealArray& force) const;
    // The same on others' particles, in their entries of `force`, after placeOthers.
    void spreadToOthers(Vectors f, particles::RealArray& force) const;

    const std::vector<int>& touched() const { return own_.touched; }  // particles of this rank with weights
    const std::vector<int>& touchedOthers() const {
        return others_.touched;
    }  // entries of others' particles with weights

    long fallbacks() const { return fallbacks_; }  // nodes of the last build with Shepard's weights, for either reason
    long mostFallbacks() const { return mostFallbacks_; }  // of any build

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

        void clear() { first.assign(1, 0), entries.clear(), touched.clear(); }
        void findTouched(std::size_t particles);
    };
    using Polynomial = Eigen::Matrix<double, 5, 1>;  // c0, c, c2
    template <class F>
    void forCells(F&& f) const;  // f(cell, its first and last node)
    void spreadBy(const Weights& weights, const Vectors& f, particles::RealArray& force) const;
    void project(Vectors& v) const;
    void findEntries(const particles::ParticleSystem& system, const std::vector<double>& volume);
    void findWeights();

    std::vector<Cell>& cells_;
    double radius_;
    std::size_t nodes_ = 0;
    MPI_Comm comm_ = MPI_COMM_NULL;
    Weights own_, others_;
    std::vector<Polynomial> along_, extra_;                      // of each node
    Vectors normal_;                                             // of each node; 0 where it has no area
    std::vector<membrane::BlockStiffness> stiffness_, damping_;  // K and C of each cell
    Vectors gradient_;                                           // g of closed cells, 0 of open ones
    long fallbacks_ = 0, mostFallbacks_ = 0;
};

}  // namespace corpuscle::coupling
