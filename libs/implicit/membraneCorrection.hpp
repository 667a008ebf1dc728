// What a stiff membrane adds to a preconditioner of the fluid. With B the inverse of the fluid's part, K' = (middle +
// lead) k + C, times of Reach (term.hpp) and S the interpolation to the nodes with the volume kept, the inverse of both
// together is (Woodbury)
//
//     (B^-1 + S^T K' S)^-1 = B - B S^T y,   y = K' x,   (1 + N K') x = S B r,   N = S B S^T
// The system for x lives on the nodes alone. Conjugate gradients solve it as K' (1 + N K') x = K' S B r, symmetric and
// positive semi-definite, preconditioned by K'^-1: of the residual that makes S B r - (1 + N K') x, which they carry
// along. So the iterations of the whole become those of the fluid, however stiff the membrane is.
//
// How far: where x leaves the residual s, the energy of the error of z is s.(1 + K' N)^-1 K' N K' s, which is below
// s.K' s, and nearly that where the membrane is stiff. It is made a small share of r.z, the energy of z. (A share of
// the first residual asks too much of a soft membrane and too little of a stiff one, whose first residual is the larger
// the stiffer it is.)
//
// While x is looked for, all that acts on the grid and all that is asked of it lies in the planes of the membranes.
#pragma once
#include <utility>

#include "coupling/immersed.hpp"
#include "implicit/coarseGrid.hpp"
#include "implicit/conjugateGradients.hpp"

namespace corpuscle::implicit {

template <class Real>
class MembraneCorrection {
  public:
    using Field = particles::AlignedVector<Real>;
    static constexpr double tolerance = 0.2;  // in the norm of energy, of z
    static constexpr int most = 1000;

    // z = (B^-1 + S^T K' S)^-1 r with B = diag(inverse) + P A_c^-1 P^T, four numbers a particle: `own` of this rank,
    // then those of others that it knows, in r as in z. Collective.
    void apply(MPI_Comm comm, coupling::Immersed& immersed, CoarseGrid& grid, double time, const Field& inverse,
               std::size_t own, const Field& r, Field& z);

    long takeIterations() { return std::exchange(iterations_, 0); }  // since it was asked last

  private:
    using Vectors = coupling::Immersed::Vectors;
    using Solver = ConjugateGradients<double>;
    // What one application of the preconditioner has to do with.
    struct Parts {
        MPI_Comm comm;
        coupling::Immersed& immersed;
        CoarseGrid& grid;
        CoarseGrid::Planes planes;
        double time;
        const Field& inverse;
    };
    Vectors resistance(const Parts& parts, const Vectors& u) const;  // K' u
    void scatter(const Parts& parts, const Vectors& f);              // S^T f
    template <class Force>
    Vectors onNodes(const Parts& parts, Force&& force);  // S B, from the grid's values and what acts on a particle
    // y = K' x. first: S B r; energy: r.B r, this rank's part.
    Vectors solve(const Parts& parts, const Vectors& first, double energy);

    particles::RealArray scattered_, image_;  // on the particles near membranes
    std::vector<double> gathered_;            // on the grid
    Solver solver_;
    Solver::Carried left_;  // (1 + N K') x
    long iterations_ = 0;
};

extern template class MembraneCorrection<double>;
extern template class MembraneCorrection<float>;

}  // namespace corpuscle::implicit
