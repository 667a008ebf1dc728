// Interpolation S of fluid fields to the nodes of membranes; its transpose S^T spreads forces of the nodes to the fluid
// with the same weights.
//
//     S : u_m = sum_n M_mn s_n + (x_m - sum_n M_mn x_n).grad u
//         s_m = sum_j [w_mj (1 - n n^T) + w'_mj n n^T] u_j + t H [(du/dn)_along + grad_along (u.n)],   n: normal at m
// symbol | meaning
// w, w'  | V_j W(r/R) (c.b(q)),  W Wendland C2,  q = d_j/R,  r = |d_j|,  d_j = x_j - x_m,  R = 2 dx;  b: nodeBasis.hpp
//        | sum w = 1,   sum w q = 0,   sum w phi = v along the membrane (w) and v' across it (w'),
//        | sum w rho^2 = r - s and sum w' rho^2 = r' - s
// s      | mean square distance of M at the node, in R^2, so that M and w together have the second moments r, r'
// M      | mean along the membrane (membraneSmoothing.hpp); the identity where edges are longer than 1.2 dx
// grad   | by weights of the same form that have 1 for q_k and 0 for the rest of the basis
// H      | support of the fluid's kernel
// v, t   | chosen so that nodes move as in the exact flow along a flat membrane between two fluids (flatMembrane.hpp)
// v',r,r'| 0.23, -0.07, 0.02, fitted to the responses of a sphere to loads of all kinds
//        | (tests/implicit/loadedSphere.cpp)
// Constant and linear fields are interpolated exactly, except where sum_j |w_mj| or sum_j |w'_mj| is above 4, as with
// fluid on one side only: there, s_m is partly or entirely the mean with the weights V_j W (shareOfMean in
// nodeBasis.hpp), and the other weights are multiplied by the share that is left.
//
// A rank has the weights of its own particles for the nodes of the cells that it holds. Sums over the particles around
// a node are completed among the holders of its cell (holderSums.hpp).
#pragma once
#include "coupling/flatMembrane.hpp"
#include "coupling/holderSums.hpp"
#include "coupling/membraneSmoothing.hpp"
#include "coupling/nodeBasis.hpp"
#include "coupling/nodeLayout.hpp"
#include "particles/sharedParticles.hpp"

namespace corpuscle::coupling {

// Positions and volumes of all ghosts of a rank, as on the ranks that own the particles.
class GhostRecords {
  public:
    // volume: of each own particle [m^3]. Collective.
    GhostRecords(particles::ParticleSystem& system, const particles::SharedParticles& shared,
                 const std::vector<double>& volume);
    Vec3 position(int ghost) const { return Vec3::Map(&records_[first_ + 4 * static_cast<std::size_t>(ghost)]); }
    double volume(int ghost) const { return records_[first_ + 4 * static_cast<std::size_t>(ghost) + 3]; }

  private:
    std::size_t first_;
    particles::RealArray records_;  // four numbers of each own particle and each ghost
};

class NodeFluidMap {
  public:
    static constexpr double radiusInSpacings = 2;
    static constexpr double kinkAcross = 0.23, squareAlong = -0.07, squareAcross = 0.02;  // v', r, r'

    // conditions: v and t of each type of cell. support: of the fluid's kernel [m].
    NodeFluidMap(double spacing, double support, std::vector<NodeConditions> conditions)
        : radius_(radiusInSpacings * spacing),
          support_(support),
          conditions_(std::move(conditions)),
          smoothing_(spacing) {}

    // Computes the weights at the present positions; lists must be up to date. volume: of each particle [m^3].
    // Collective. Throws Failure(numerics), on all ranks, if a node has no fluid around it.
    void place(const Cells& cells, const NodeLayout& layout, const particles::ParticleSystem& system,
               const std::vector<double>& volume);
    // Weights of ghosts, to be called right after `place`.
    void placeOthers(const Cells& cells, const NodeLayout& layout, const particles::ParticleSystem& system,
                     const particles::SharedParticles& shared, const GhostRecords& ghosts);

    // S u, u of four numbers per particle. Collective among holders.
    template <class Real>
    NodeVectors interpolate(const Real* u);
    // v += S of the slide velocities of images, if images of the box slide: nodes interpolate from the images beside
    // them.
    void addSlides(NodeVectors& v) const {
        for (std::size_t m = 0; m < slides_.size(); ++m) v[m] += slides_[m];
    }
    // force_j += (S^T f)_j, of four numbers per particle: for own particles; for ghosts, into their entries.
    void spread(const NodeVectors& f, particles::RealArray& force) const { spreadBy(own_, f, force); }
    void spreadToOthers(const NodeVectors& f, particles::RealArray& force) const { spreadBy(others_, f, force); }

    const std::vector<int>& touched() const { return own_.touched; }  // own particles with weights for any node
    // Own particles with weights for the nodes of one held cell.
    const std::vector<int>& touchedBy(std::size_t cell) const { return own_.touchedBy[cell]; }
    const std::vector<int>& touchedOthers() const { return others_.touched; }  // entries of ghosts

    // f(node, particle, V W) for the own particles within R of the nodes from `first` up to, but not including, `last`.
    template <class F>
    void forNear(std::size_t first, std::size_t last, F&& f) const {
        for (std::size_t m = first; m < last; ++m)
            for (std::size_t k = firstNear_[m]; k < firstNear_[m + 1]; ++k) f(m, near_[k].particle, near_[k].weight);
    }

    // Number of nodes with a share of the plain mean at the last `place`, over all ranks; and the largest of any
    // `place`.
    long fallbacks() const { return fallbacks_; }
    long mostFallbacks() const { return mostFallbacks_; }

  private:
    struct Near {  // a particle within R of a node
        int particle;
        double weight;  // V W
        Vec3 q;
    };
    struct Entry {
        int particle;
        double along, extra, shift;  // w, w' - w, weight of (x_m - sum M x).grad
    };
    struct Weights {
        std::vector<std::size_t> first;  // first entry of each node, and the number of all entries
        std::vector<Entry> entries;
        NodeVectors slopes;  // weights of t H grad of each entry; empty if t = 0 for all types of cell
        std::vector<int> touched;
        std::vector<std::vector<int>> touchedBy;  // for each cell

        void clear() { first.assign(1, 0), entries.clear(), slopes.clear(), touched.clear(), touchedBy.clear(); }
        void findTouched(const NodeLayout& layout, std::size_t particles);
    };
    struct Coefficients {  // c of the weights of one node
        NodeBasis::Vector along, across, shift;
        Eigen::Matrix<double, NodeBasis::size, 3> slope;
        void mix(double share, const NodeBasis::Vector& mean);  // `mean`: coefficients of the plain mean
    };
    void findNormals(const Cells& cells);
    void findNear(const Cells& cells, const particles::ParticleSystem& system, const std::vector<double>& volume);
    void findCoefficients(const Cells& cells, const NodeLayout& layout, MPI_Comm comm);
    Coefficients solve(const Cell& cell, std::size_t m, const double* moments) const;
    void add(const Near& near, std::size_t m, Weights& weights) const;
    bool hasSlopes() const;
    template <class VelocityOf>
    NodeVectors interpolateBy(VelocityOf&& velocityOf);
    void findSlides(const Periodicity& period, const particles::ParticleStore& s, const Cells& cells);
    void spreadBy(const Weights& weights, const NodeVectors& f, particles::RealArray& force) const;

    double radius_, support_;
    std::vector<NodeConditions> conditions_;
    MembraneSmoothing smoothing_;
    HolderSums sums_;
    std::vector<std::size_t> firstNear_;      // first entry of each node in near_, and the number of all entries
    std::vector<Near> near_;                  // own particles
    Weights own_, others_;                    // of own particles, of ghosts
    std::vector<Coefficients> coefficients_;  // of each node
    NodeVectors normal_;                      // of each node; 0 if the node has no area
    NodeVectors slides_;                      // of each node; empty if images of the box do not slide
    long fallbacks_ = 0, mostFallbacks_ = 0;
};

}  // namespace corpuscle::coupling
