// What a stiff membrane adds to a preconditioner of the fluid. With B the inverse of the fluid's part, K' = (middle + lead) k + C, times of Reach (term.hpp) and S the
// interpolation to the nodes with the volume kept, the inverse of both together is (Woodbury)
//
//     (B^-1 + S^T K' S)^-1 = B - B S^T y,   y = K' x,   (1 + N K') x = S B r,   N = S B S^T
// The system for x lives on the nodes alone. 1 + N K' is symmetric in the inner product of K', and conjugate gradients solve it there. So
// the iterations of the whole become those of the fluid, however stiff the membrane is.
#pragma once
#include <utility>

#include "coupling/immersed.hpp"
#include "implicit/coarseGrid.hpp"

namespace corpuscle::implicit {

template <class Real>
class MembraneCorrection {
  public:
    using Field = particles::AlignedVector<Real>;
    static constexpr double tolerance = 1e-3;  // of the residual, in the norm of K'
    static constexpr int most = 60;

    // z = (B^-1 + S^T K' S)^-1 r with B = diag(inverse) + P A_c^-1 P^T, four numbers a particle; those of others that the rank
    // knows stand behind its own, in r as in z. Collective.
    void apply(MPI_Comm comm, const coupling::Immersed& immersed, CoarseGrid& grid, double time, const Field& inverse,
               const Field& r, Field& z);

    long takeIterations() { return std::exchange(iterations_, 0); }  // since it was asked last

  private:
    using Vectors = coupling::Immersed::Vectors;
    particles::RealArray scattered_, image_;  // on the particles near membranes
    std::vector<double> solution_, ofGrid_;   // on the grid
    long iterations_ = 0;
};

extern template class MembraneCorrection<double>;
extern template class MembraneCorrection<float>;

}  // namespace corpuscle::implicit
