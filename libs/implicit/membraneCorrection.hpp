// Contribution of a stiff membrane to a preconditioner of the fluid. Let B be the inverse of the fluid's part, K' =
// (middle + lead) k + C with the times of Reach (term.hpp), and S the interpolation to the nodes that keeps the volume.
// The inverse of both parts together is then (Woodbury)
//
//     (B^-1 + S^T K' S)^-1 = B - B S^T y,   y = K' x,   (1 + N K') x = S B r,   N = S B S^T
// The unknowns x of this system belong to the nodes alone. It is solved by conjugate gradients as
// K' (1 + N K') x = K' S B r, which is symmetric and positive semi-definite, with K'^-1 as the preconditioner: applied
// to the residual, it gives S B r - (1 + N K') x, which the solver carries along. The iterations of the whole system
// thus become those of the fluid, however stiff the membrane is.
//
// Stopping: where x leaves the residual s, the energy of the error of z is s.(1 + K' N)^-1 K' N K' s, which is below
// s.K' s, and close to it if the membrane is stiff. s.K' s is made a small share of r.z, the energy of z. (A share of
// the first residual would be too strict for a soft membrane and too loose for a stiff one, because the first residual
// grows with the stiffness.)
//
// During the iterations for x, all forces on the grid and all values taken from it lie in the planes of the membranes.
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
    static constexpr double tolerance = 0.2;  // of z, in the energy norm
    static constexpr int most = 1000;

    // z = (B^-1 + S^T K' S)^-1 r with B = diag(inverse) + P A_c^-1 P^T. time: middle + lead [s]. r and z have four
    // numbers per particle: first the `own` particles of this rank, then those of other ranks that it knows.
    // Collective.
    void apply(MPI_Comm comm, coupling::Immersed& immersed, CoarseGrid& grid, double time, const Field& inverse,
               std::size_t own, const Field& r, Field& z);

    long takeIterations() { return std::exchange(iterations_, 0); }  // since the last call

  private:
    using Vectors = coupling::Immersed::Vectors;
    using Solver = ConjugateGradients<double>;
    // The data of one application of the preconditioner.
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
    Vectors onNodes(const Parts& parts, Force&& force);  // S B, from grid values and the force on each particle
    // Returns y = K' x. first: S B r; energy: r.B r, this rank's part.
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
