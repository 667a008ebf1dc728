// Preconditioners of the implicit step, z = M^-1 r, by the names that `implicit.preconditioner` has:
//
// name         | M^-1
// blockJacobi  | the inverse of the diagonal
// twoLevel     | that, and the flow of a uniform fluid on a background grid (coarseGrid.hpp)
// withMembrane | twoLevel, and the membranes in full (membraneCorrection.hpp); without cells twoLevel
// automatic    | twoLevel, or withMembrane where the membranes are stiff: at each step by measure
//
// Rigid bodies stand around any of them: Pi M^-1 Pi^T (rigidUnknowns.hpp). All are symmetric and positive definite on
// what is not prescribed, but for withMembrane, which iterates and is so to its tolerance.
#pragma once
#include <memory>
#include <string>

#include "implicit/system.hpp"

namespace corpuscle::implicit {

template <class Real>
class Preconditioner {
  public:
    using Field = typename System<Real>::Field;
    virtual ~Preconditioner() = default;

    // For the system as it has been prepared. Collective.
    virtual void prepare() = 0;
    // Gives 0 where the velocity is prescribed. Collective.
    virtual void apply(const Field& r, Field& z) = 0;
    virtual long takeInnerIterations() { return 0; }  // on the nodes, since it was asked last
};

// Whether the preconditioner of this name has a part on the background grid.
bool isOnGrid(const std::string& name);

// The system must stay where it is.
template <class Real>
std::unique_ptr<Preconditioner<Real>> makePreconditioner(const std::string& name, System<Real>& system);

extern template std::unique_ptr<Preconditioner<double>> makePreconditioner(const std::string&, System<double>&);
extern template std::unique_ptr<Preconditioner<float>> makePreconditioner(const std::string&, System<float>&);

}  // namespace corpuscle::implicit
