// Preconditioners of the implicit step, z = M^-1 r, by their names in `implicit.preconditioner`:
//
// name         | M^-1
// blockJacobi  | the inverse of the diagonal
// twoLevel     | blockJacobi plus the flow of a uniform fluid on a background grid (coarseGrid.hpp)
// withMembrane | twoLevel plus the membranes in full (membraneCorrection.hpp); without cells, twoLevel
// automatic    | twoLevel, or withMembrane where the membranes are stiff, which is measured at each step
//
// With rigid bodies, each of them becomes Pi M^-1 Pi^T (rigidUnknowns.hpp). All are symmetric and positive definite on
// the rows that are not prescribed, withMembrane only to the tolerance of its inner iteration.
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

    // For the system as last prepared. Collective.
    virtual void prepare() = 0;
    // z = M^-1 r, 0 where the velocity is prescribed. Collective.
    virtual void apply(const Field& r, Field& z) = 0;
    virtual long takeInnerIterations() { return 0; }  // on the nodes, since the last call
};

// Whether the preconditioner of this name has a part on the background grid.
bool isOnGrid(const std::string& name);

// The system is kept by reference.
template <class Real>
std::unique_ptr<Preconditioner<Real>> makePreconditioner(const std::string& name, System<Real>& system);

extern template std::unique_ptr<Preconditioner<double>> makePreconditioner(const std::string&, System<double>&);
extern template std::unique_ptr<Preconditioner<float>> makePreconditioner(const std::string&, System<float>&);

}  // namespace corpuscle::implicit
