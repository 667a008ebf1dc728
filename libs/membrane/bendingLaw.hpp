// Family of bending laws. A law derives from BendingLaw and makes its Term; dihedralBending.hpp is the pattern. A law
// may define its constant relative to the membrane (Eb = kappa/(Gs a^2)); for this it is given the membrane's scale.
#pragma once
#include <memory>

#include "membrane/network.hpp"
#include "membrane/term.hpp"

namespace corpuscle::membrane {

struct MembraneScale {
    double shearModulus = 0;  // Gs of bonds (closed form of a hexagonal network) and triangles, N/m
    double radius = 0;        // a: disc radius of a red cell, radius of a capsule, m
};

class BendingLaw {
  public:
    static constexpr const char* familyName = "bending law";
    virtual ~BendingLaw() = default;
    virtual std::unique_ptr<Term> makeTerm(Network& network, const MembraneScale& scale) const = 0;
    virtual double bendingModulus(const MembraneScale& scale) const = 0;  // kappa, J
};

}  // namespace corpuscle::membrane
