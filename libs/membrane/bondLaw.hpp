// Family of the laws of a bond: energy E(l, l0) of a bond of length l with rest length l0.
//
// A law is a struct that derives from BondLawOf<itself> and has its coefficients, schema(), and
//     energy(l, l0) [J], derivative(l, l0) = dE/dl, the tension [N], secondDerivative(l, l0) [N/m].
// The rest (loop, closed-form moduli, tensions for output) follows from these three; harmonicBond.hpp is the pattern.
//
// Closed form for a hexagonal network of bonds that are free of force at rest:
//     Gs = sqrt(3)/4 E''(l0, l0),   Ks = sqrt(3)/2 E''(l0, l0)
// A real mesh is not hexagonal: moduli.hpp measures what it has.
#pragma once
#include <cmath>
#include <memory>

#include "membrane/elementTerm.hpp"

namespace corpuscle::membrane {

struct SurfaceModuli {
    double shear = 0;  // Gs, N/m
    double area = 0;   // Ks, N/m
};

class BondLaw {
  public:
    static constexpr const char* familyName = "bond law";
    virtual ~BondLaw() = default;
    virtual std::unique_ptr<Term> makeTerm(Network& network) const = 0;
    virtual double tension(double l, double l0) const = 0;    // dE/dl, N
    virtual double stiffness(double l, double l0) const = 0;  // d2E/dl2, N/m

    SurfaceModuli hexagonalModuli(double l0) const {
        const double k = stiffness(l0, l0);
        return {std::sqrt(3.0) / 4 * k, std::sqrt(3.0) / 2 * k};
    }
};

template <class Law>
class BondLawOf : public BondLaw {
  public:
    std::unique_ptr<Term> makeTerm(Network& network) const override {
        return std::make_unique<BondTerm<Law>>(network, law());
    }
    double tension(double l, double l0) const override { return law().derivative(l, l0); }
    double stiffness(double l, double l0) const override { return law().secondDerivative(l, l0); }

  private:
    const Law& law() const { return static_cast<const Law&>(*this); }
};

}  // namespace corpuscle::membrane
