// The smooth part of a preconditioner: the flow of a uniform fluid on a background grid, solved exactly.
//
//     z = P A_c^-1 P^T r,    A_c: c1 rho u - mu lap u - lambda grad div u   in trilinear finite elements
// on cuboids, or where the images of the box slide on the parallelepipeds of coordinates in which it is periodic,
//     xi = x - t (s - s_low),   d/ds = d/dxi_s - t.d/dxi,   s: coordinate across,   t: offset of the next image/L_s
// symbol  | meaning
// P       | trilinear interpolation from the grid to the particles
// c1 rho  | inertia of the step [kg/(m^3 s)]
// lambda  | bulk modulus x time over which pressure is implicit [Pa s]
//
// The coefficients are constants, so that A_c falls apart into Fourier modes along the periodic axes; between walls
// each mode is a block tridiagonal system of 3 x 3 blocks, factorised once for as long as step and fluid stay the same.
// On the grid's nodes at the walls the velocity is zero. What the grid does not resolve, and the membrane, is left to
// the rest of the preconditioner. The work is a few per cent of one application of the operators, and every rank does
// all of it.
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

    // box: of the fluid; the axis that is not periodic, if there is one, has walls. spacing: of the grid, about.
    CoarseGrid(const particles::Box& box, double spacing);
    ~CoarseGrid();
    CoarseGrid(const CoarseGrid&) = delete;
    CoarseGrid& operator=(const CoarseGrid&) = delete;

    // inertia c1 rho, viscosity, lambda; images of the box. Factorises when they have changed.
    void setCoefficients(double inertia, double viscosity, double lambda, const Periodicity& images = {});

    // Which nodes each particle has, for `add`: those of this rank, then ghosts, which take from the grid and give
    // nothing.
    void begin(std::size_t particles, std::size_t copies = 0) {
        own_ = particles;
        places_.assign(particles + copies, Place{});
    }
    // Particles without a place take no part. Any image of x; after setCoefficients.
    void place(std::size_t particle, Vec3 x);

    // z += P A_c^-1 P^T r, four numbers a particle. Collective.
    template <class Real>
    void add(MPI_Comm comm, const Real* r, Real* z);

    // Planes of nodes between the walls, of which the first is one step from the lower wall; without walls always all
    // of them.
    struct Planes {
        int first, last;
    };
    Planes all() const { return {0, count_[0] - 1}; }
    Planes planesOf(MPI_Comm comm, const std::vector<int>& particles) const;  // of particles of all ranks. Collective.

    // The same in parts: values = P^T r of this rank; values <- A_c^-1 values, added up over the ranks; z += P values.
    // With `particles` and their planes only these are looked at, and the values of other planes are taken to be zero
    // and not found: a cell is far smaller than its box.
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
    // Of these planes: f(first, last) of each component, [first, last) in values().
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
        int node[3][2] = {};      // along each axis
        float weight[3][2] = {};  // of these, 0 at a wall
    };
    struct Plans;
    struct Symbol {  // of one axis: mass, stiffness, and of the derivative
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
    // Node of a component.
    std::size_t firstOf(int plane) const {
        return static_cast<std::size_t>(plane) * static_cast<std::size_t>(count_[1] * count_[2]);
    }
    template <class F>
    void forCorners(const Place& place, F&& f) const;  // f(node, weight), eight times

    particles::Box box_;
    std::array<int, 3> axis_{};  // the axis across the walls (or the last), then the other two: slowest first in memory
    std::array<int, 3> count_{};  // nodes along these
    Vec3 step_ = Vec3::Zero();    // along these [m]
    bool walls_ = false;
    double inertia_ = 0, viscosity_ = 0, lambda_ = 0;
    int sliding_ = -1;          // s, along the box; -1: nothing slides
    Vec3 tilt_ = Vec3::Zero();  // t
    std::size_t own_ = 0;
    std::vector<Place> places_;
    // Values of a node side by side, x y z and a number without meaning: one vector for what particles take or give.
    std::vector<Quad> quads_;
    std::unique_ptr<Plans> plans_;
    std::vector<Block> inverse_;  // of the pivots of every mode, planes taken in from below; or of the mode
    std::vector<Block> upper_;    // of every mode between two planes
    std::vector<Block> closed_;   // of the pivots of one plane, those above taken in as well
    int closedAt_ = -1;           // that plane
};

}  // namespace corpuscle::implicit
