// Family of three-point angle laws: the energy E(theta, theta0) of each corner of each triangle, with its angle theta
// and its angle theta0 in the stress-free mesh. These laws resist in-plane shear; those of bendingLaw.hpp resist
// bending.
//
// A law is a struct that derives from AngleLawOf<itself> and has its coefficients, schema(), energy [J], derivative
// [J/rad] and secondDerivative [J/rad^2]; harmonicAngle.hpp is the pattern.
#pragma once
#include <memory>

#include "membrane/elementTerm.hpp"

namespace corpuscle::membrane {

class AngleLaw {
  public:
    static constexpr const char* familyName = "angle law";
    virtual ~AngleLaw() = default;
    virtual std::unique_ptr<Term> makeTerm(Network& network) const = 0;
};

template <class Law>
class AngleLawOf : public AngleLaw {
  public:
    std::unique_ptr<Term> makeTerm(Network& network) const override {
        network.useCorners();
        return std::make_unique<CornerTerm<Law>>(network, static_cast<const Law&>(*this));
    }
};

}  // namespace corpuscle::membrane
