// Family of bond laws: the energy E(l, l0) of a bond of length l with rest length l0.
//
// A law is a struct that derives from BondLawOf<itself> and has its coefficients, schema(), constants(l0), and
//     energy(l, l0) [J], derivative(l, l0) = dE/dl, the tension [N], secondDerivative(l, l0) [N/m].
// Everything else (loop, closed-form moduli, tensions for output) follows from these three; harmonicBond.hpp is the
// pattern.
//
// Closed form for a hexagonal network of bonds that are free of force at rest:
//     Gs = sqrt(3)/4 E''(l0, l0),   Ks = sqrt(3)/2 E''(l0, l0)
// A real mesh is not hexagonal: moduli.hpp measures its actual moduli.
//
// With the key `scaled`, which every law has, the energy of each bond is multiplied by its share w of the surface,
//     w = 2/sqrt(3) (A_left + A_right)/l0^2              (1 on a hexagonal network; at a border, one triangle)
// In an affine strain eps, bonds of direction n have the energy 1/2 sum_b w_b E''_b l0^2 (n.eps.n)^2. Averaged over
// directions it gives Gs = 1/(8 A) sum_b w_b E''_b l0^2, and with E'' = 4 Gs/sqrt(3) the sum is
// 8/3 Gs sum_b (A_left + A_right) = 8 Gs A, since each triangle has three bonds. So any mesh has the closed-form
// moduli, as means over the directions: large and small triangles are equally stiff, but the anisotropy of a
// neighbourhood stays.
#pragma once
#include <cmath>
#include <memory>
#include <string>

#include "membrane/elementTerm.hpp"
#include "membrane/surfaceModuli.hpp"

namespace corpuscle::membrane {

class BondLaw {
  public:
    static constexpr const char* familyName = "bond law";
    bool scaled = false;

    virtual ~BondLaw() = default;
    virtual std::unique_ptr<Term> makeTerm(Network& network) const = 0;
    virtual double tension(double l, double l0) const = 0;    // dE/dl, N; without the weight
    virtual double stiffness(double l, double l0) const = 0;  // d2E/dl2, N/m; without the weight
    virtual std::string constants(double l0) const = 0;       // of a bond of this rest length, as text for the user
    double weight(const Network& network, const Bond& bond) const;  // w; 1 unless scaled

    SurfaceModuli hexagonalModuli(double l0) const {
        const double k = stiffness(l0, l0);
        return {std::sqrt(3.0) / 4 * k, std::sqrt(3.0) / 2 * k};
    }

  protected:
    // Spring provides energy, derivative and secondDerivative.
    template <class Spring>
    std::unique_ptr<Term> termOf(const Network& network, const Spring& spring) const {
        if (!scaled) {
            return std::make_unique<BondTerm<Spring>>(network, spring);
        }
        return std::make_unique<BondTerm<Spring, Weights>>(network, spring, weights(network));
    }

  private:
    Weights weights(const Network& network) const;
};

template <class Law>
class BondLawOf : public BondLaw {
  public:
    std::unique_ptr<Term> makeTerm(Network& network) const override { return termOf(network, law()); }
    double tension(double l, double l0) const override { return law().derivative(l, l0); }
    double stiffness(double l, double l0) const override { return law().secondDerivative(l, l0); }

  private:
    const Law& law() const { return static_cast<const Law&>(*this); }
};

inline constexpr const char* scaledText = "each bond times its share of the surface, so that the mesh has the moduli";

}  // namespace corpuscle::membrane
