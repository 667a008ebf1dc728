// Family of equations of state: pressure of a weakly compressible fluid from its density.
//
// The sound speed is not that of water but a numerical one: large enough that density varies by less than a per cent.
// With plain operators `soundSpeed: auto` takes
//     c0^2 = 100 max(U^2, nu U/l, Gs/(rho a), F L)
// with U the largest speed that walls or body force give, l the smallest of gap and cell radius, F the body force and L
// the length of the flow (flow.hpp).
#pragma once
#include <optional>

#include "core/registry.hpp"

namespace corpuscle::sph {

class EquationOfState {
  public:
    static constexpr const char* familyName = "equation of state";
    virtual ~EquationOfState() = default;

    std::optional<double> soundSpeed;  // c0 [m/s]; empty: automatic

    // out[i] = p(rho[i])/rho[i]^2, the form in which pressure enters the momentum equation, for n particles.
    virtual void specificPressure(const double* density, double* out, int n, double restDensity, double c0) const = 0;
    virtual double pressure(double density, double restDensity, double c0) const = 0;
    // Energy of compression per unit mass, int p/rho^2 drho from the rest density [J/kg].
    virtual double energy(double density, double restDensity, double c0) const = 0;
    virtual double bulkModulus(double density, double restDensity, double c0) const = 0;  // rho dp/drho [Pa]
    virtual double density(double pressure, double restDensity, double c0) const = 0;
};

}  // namespace corpuscle::sph
