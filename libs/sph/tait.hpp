// Tait's equation of state (paper, Eq 7):
//     p = rho0 c0^2/gamma ((rho/rho0)^gamma - 1)
// symbol | meaning                     | unit
// rho0   | density at zero pressure    | kg/m^3
// c0     | sound speed at rho0         | m/s
// gamma  | exponent, 7 by default      | -
// Source: J. J. Monaghan, J. Comput. Phys. 110 (1994) 399.
#pragma once
#include "sph/equationOfState.hpp"

namespace corpuscle::sph {

struct Tait : EquationOfState {
    double gamma = 7;
    static const Schema<Tait>& schema();
    void specificPressure(const double* density, double* out, int n, double restDensity, double c0) const override;
    double pressure(double density, double restDensity, double c0) const override;
    double energy(double density, double restDensity, double c0) const override;
    double bulkModulus(double density, double restDensity, double c0) const override;
    double density(double pressure, double restDensity, double c0) const override;
};

}  // namespace corpuscle::sph
