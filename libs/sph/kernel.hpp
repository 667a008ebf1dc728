// Family of smoothing kernels, from which a case chooses. The formulas, one header each, are lucy.hpp, wendlandC2.hpp,
// quintic.hpp; this header has what set-up and analysis need. H_s is the support radius, h = H_s/2 the smoothing
// length, for every kernel.
#pragma once
#include <memory>
#include <optional>

#include "core/registry.hpp"
#include "sph/pairKernels.hpp"

namespace corpuscle::sph {

class Kernel {
  public:
    static constexpr const char* familyName = "kernel";
    virtual ~Kernel() = default;
    std::optional<Length> support;  // H_s; a loaded case has one

    virtual KernelKind kind() const = 0;
    // The support, in spacings, if a case names none. Plain operators need a small error of the second moment;
    // corrected ones divide by the second moment and use the support with the least error for its cost
    // (benchmarks/numerics).
    virtual double usualSupport(bool corrected) const = 0;
    virtual std::shared_ptr<const Kernel> withSupport(Length support) const = 0;
    virtual double normalisation(double H) const = 0;          // W = normalisation * value(r/H)
    virtual double gradientNormalisation(double H) const = 0;  // -W'(r)/r = gradientNormalisation * slope(r/H)
    virtual double value(double q) const = 0;
    virtual double slope(double q) const = 0;

    // S2 = sum_j dx^3 (x_ij^2/r)(-dW/dr) on a cubic lattice. S2 - 1 is the relative error of the viscosity in a flow of
    // particles on that lattice.
    double secondMoment(double supportOverSpacing) const;
    // Largest eigenvalue of Morris' viscosity per mass on a cubic lattice, in nu/dx^2.
    double viscousRate(double supportOverSpacing) const;
    // Neighbours within the support on a cubic lattice, the particle itself included.
    int latticeNeighbours(double supportOverSpacing) const;
};

}  // namespace corpuscle::sph
