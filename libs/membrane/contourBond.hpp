// Common part of bonds of finite extent: an attraction that grows without bound towards the contour length lm = l0/x0,
// and a repulsion of power m that balances it at the bond's own rest length l0. With s = l/l0, x = x0 s:
//     E   = a l0 ( (U(x) - U(x0))/x0 + g(x0) (s^(1-m) - 1)/(m-1) )           zero at rest
//     E'  = a ( g(x) - g(x0) s^-m ),     kp = a g(x0) l0^m                    exactly zero at rest
//     E'' = a/l0 ( x0 g'(x) + m g(x0) s^-(m+1) )
// symbol | meaning                                                        | unit
// a      | strength of the attraction, constant or proportional to l0     | N
// U, g   | Chain's energy and force over a, of x = l/lm; g = U'           | -
// x0     | l0/lm                                                          | -
// m      | exponent of the repulsion, above 1                             | -
// kp     | constant of the repulsion                                      | N m^m
// On a hexagonal network Gs = sqrt(3)/4 E''(l0) = sqrt(3)/4 a/l0 S,  S = x0 g'(x0) + m g(x0); Ks = 2 Gs.
//
// At its contour length and beyond, a bond has infinite energy, so that a line search rejects such a step; its force
// and stiffness throw Failure(numerics), which ends a run with the last checkpoint on disk. Rupture by bond stretch
// comes first where its limit is below 1/x0.
#pragma once
#include <cmath>
#include <limits>
#include <optional>

#include "membrane/bondLaw.hpp"

namespace corpuscle::membrane {

[[noreturn]] void beyondContour(double l, double l0, double x0);

template <class Chain>
struct ContourSpring {
    double x0, m;
    double strength = 0, strengthPerLength = 0;  // a = strength + strengthPerLength l0
    double force0 = Chain::force(x0), energy0 = Chain::energy(x0);

    double a(double l0) const { return strength + strengthPerLength * l0; }
    double stiffnessNumber() const { return x0 * Chain::slope(x0) + m * force0; }  // S

    double energy(double l, double l0) const {
        const double s = l / l0, x = x0 * s;
        if (!(x < 1)) {
            return std::numeric_limits<double>::infinity();
        }
        return a(l0) * l0 * ((Chain::energy(x) - energy0) / x0 + force0 * (power(s) * s - 1) / (m - 1));
    }
    double derivative(double l, double l0) const {
        return a(l0) * (Chain::force(ratio(l, l0)) - force0 * power(l / l0));
    }
    double secondDerivative(double l, double l0) const {
        const double s = l / l0;
        return a(l0) / l0 * (x0 * Chain::slope(ratio(l, l0)) + m * force0 * power(s) / s);
    }

  private:
    double ratio(double l, double l0) const {
        const double x = x0 * (l / l0);
        if (!(x < 1)) {
            beyondContour(l, l0, x0);
        }
        return x;
    }
    double power(double s) const { return m == 2 ? 1 / (s * s) : std::pow(s, -m); }  // s^-m
};

// Bond law of this spring. The strength follows from Gs, or from constants that Law puts into the spring by
// setStrength(spring).
template <class Law, class Chain>
class ContourBondOf : public BondLaw {
  public:
    double x0 = 0, m = 2;
    std::optional<double> Gs;  // N/m

    ContourSpring<Chain> spring() const {
        ContourSpring<Chain> result{x0, m};
        if (Gs) {
            result.strengthPerLength = 4 / std::sqrt(3.0) * *Gs / result.stiffnessNumber();
        } else {
            static_cast<const Law&>(*this).setStrength(result);
        }
        return result;
    }
    std::unique_ptr<Term> makeTerm(Network& network) const override { return termOf(network, spring()); }
    double tension(double l, double l0) const override { return spring().derivative(l, l0); }
    double stiffness(double l, double l0) const override { return spring().secondDerivative(l, l0); }
    double repulsion(double l0) const { return spring().a(l0) * spring().force0 * std::pow(l0, m); }  // kp, N m^m
};

}  // namespace corpuscle::membrane
