// The smooth part of a preconditioner: the flow of a uniform fluid on a background grid, solved exactly.
//
//     z = P A_c^-1 P^T r,    A_c: c1 rho u - mu lap u - lambda grad div u   in trilinear finite elements
// The elements are cuboids. Where the images of the box slide, the elements are parallelepipeds, which are cuboids in
// the coordinates in which the box is periodic without an offset,
//     xi = x - t (s - s_low),   d/ds = d/dxi_s - t.d/dxi
// symbol  | meaning
// P       | trilinear interpolation from the grid to the particles
// c1 rho  | inertia of the step [kg/(m^3 s)]
// lambda  | bulk modulus x time over which pressure is implicit [Pa s]
// s       | coordinate across the faces that slide; s_low: that of the lower face, L_s: length of the box along s
// t       | offset of the next image/L_s
//
// The coefficients are constant in space, so that A_c separates into Fourier modes along the periodic axes. Between
// walls each mode is a block tridiagonal system of 3 x 3 blocks, whose factors are kept as long as time step and fluid
// stay the same. The velocity is zero on grid nodes at the walls. Scales that the grid does not resolve, and the
// membranes, are left to the rest of the preconditioner. Every rank does the whole work of the grid, a few per cent of
// one application of the operators.
#pragma once
#include <mpi.h>

#include <Eigen/Core>
#include <array>
#include <complex>
#include <memory>
#include <span>
#include <vector>

#include "particles/box.hpp"

namespace corpuscle::implicit {

class CoarseGrid {
  public:
    static constexpr double spacingInParticles = 2;

    // box: that of the fluid; if one of its axes is not periodic, there are walls across that axis. spacing:
    // approximate spacing of the grid [m].
    CoarseGrid(const particles::Box& box, double spacing);
    ~CoarseGrid();
    CoarseGrid(const CoarseGrid&) = delete;
    CoarseGrid& operator=(const CoarseGrid&) = delete;

    // Sets inertia c1 rho, viscosity, lambda and the images of the box. Factorises if any of them has changed.
    void setCoefficients(double inertia, double viscosity, double lambda, const Periodicity& images = {});

    // Starts a new set of particles, whose grid nodes place() finds: first those of this rank, then copies of others
    // (ghosts), which receive values from the grid but add nothing to it.
    void begin(std::size_t particles, std::size_t copies = 0) {
        own_ = particles;
        places_.assign(particles + copies, Place{});
    }
    // Finds grid nodes and weights of a particle at x, or at any periodic image of x; after setCoefficients. Particles
    // that are not placed take no part.
    void place(std::size_t particle, Vec3 x);

    // z += P A_c^-1 P^T r, four numbers per particle. Collective.
    template <class Real>
    void add(MPI_Comm comm, const Real* r, Real* z);

    // A range of the planes of grid nodes parallel to the walls; the first plane of the grid is one step from the lower
    // wall. Without walls the range is always all planes.
    struct Planes {
        int first, last;
    };
    Planes all() const { return {0, count_[0] - 1}; }
    // Planes with nodes of these particles, of all ranks. Collective.
    Planes planesOf(MPI_Comm comm, const std::vector<int>& particles) const;

    // The three parts of `add`. gather: values = P^T r of this rank; solve: values <- A_c^-1 values, after these have
    // been summed over the ranks; spread: z += P values. With `particles` and their planes, only these particles take
    // part, and values on other planes are taken as zero and not computed. This saves time, because a cell is far
    // smaller than its box.
    template <class Real>
    void gather(const Real* r) {
        gather(r, nullptr, all());
    }
    template <class Real>
    void gather(const Real* r, const std::vector<int>& particles, Planes planes) {
        gather(r, &particles, planes);
    }
    void solve(MPI_Comm comm, Planes planes);  // Collective.
    void solve(MPI_Comm comm) { solve(comm, all()); }
    template <class Real>
    void spread(Real* z) {
        spread(z, nullptr, all());
    }
    template <class Real>
    void spread(Real* z, const std::vector<int>& particles, Planes planes) {
        spread(z, &particles, planes);
    }
    std::span<double> values();  // on the nodes, component after component
    // Calls f(first, last) for each component, whose values on these planes are [first, last) in values().
    template <class F>
    void forValues(Planes planes, F&& f) const {
        for (std::size_t c = 0; c < 3; ++c)
            f(c * quads_.size() + firstOf(planes.first), c * quads_.size() + firstOf(planes.last + 1));
    }

  private:
    using Complex = std::complex<double>;
    using Block = Eigen::Matrix3cd;
    using Quad = Eigen::Array4d;
    struct Place {
        int node[3][2] = {};      // the two nodes along each axis
        float weight[3][2] = {};  // of these nodes; 0 for a node at a wall
    };
    struct Plans;
    struct Symbol {  // Fourier symbols of one axis: mass, stiffness and first derivative
        double mass, stiffness;
        Complex slope;
    };
    Symbol symbol(int axis, int mode) const;
    Block block(const std::array<Symbol, 3>& symbols) const;
    void factorise();
    void close(int plane);
    void solveModes(Planes planes);
    template <class Real>
    void gather(const Real* r, const std::vector<int>* particles, Planes planes);
    template <class Real>
    void spread(Real* z, const std::vector<int>* particles, Planes planes);
    template <class F>
    void forParticles(const std::vector<int>* particles, std::size_t all, F&& f) const;  // f(particle)
    // First node of a plane, among the nodes of one component.
    std::size_t firstOf(int plane) const {
        return static_cast<std::size_t>(plane) * static_cast<std::size_t>(count_[1] * count_[2]);
    }
    template <class F>
    void forCorners(const Place& place, F&& f) const;  // f(node, weight), eight times

    particles::Box box_;
    // The axis across the walls (without walls the last one), then the other two; the first varies slowest in memory.
    std::array<int, 3> axis_{};
    std::array<int, 3> count_{};  // nodes along these axes
    Vec3 step_ = Vec3::Zero();    // grid spacing along these axes [m]
    bool walls_ = false;
    double inertia_ = 0, viscosity_ = 0, lambda_ = 0;
    int sliding_ = -1;          // axis of the coordinate s; -1: no images slide
    Vec3 tilt_ = Vec3::Zero();  // t
    std::size_t own_ = 0;
    std::vector<Place> places_;
    // Values by node: x, y, z and an unused number, so that a particle adds or takes one vector per node.
    std::vector<Quad> quads_;
    std::unique_ptr<Plans> plans_;
    // Inverse pivots of every mode, eliminated plane by plane from below; without walls, inverse blocks of the modes.
    std::vector<Block> inverse_;
    std::vector<Block> upper_;   // coupling of each plane with the next one up, for every mode
    std::vector<Block> closed_;  // inverse pivots of one plane, with the planes above it eliminated as well
    int closedAt_ = -1;          // number of that plane; -1: none
};

}  // namespace corpuscle::implicit
