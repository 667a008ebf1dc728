// Linear equation of state:  p = c0^2 (rho - rho0)
// symbol | meaning                  | unit
// rho0   | density at zero pressure | kg/m^3
// c0     | sound speed              | m/s
// Source: Morris, Fox, Zhu, J. Comput. Phys. 136 (1997) 214.
#pragma once
#include "sph/equationOfState.hpp"

namespace corpuscle::sph {

struct Linear : EquationOfState {
    static const Schema<Linear>& schema();
    void specificPressure(const double* density, double* out, int n, double restDensity, double c0) const override;
    double pressure(double density, double restDensity, double c0) const override;
    double energy(double density, double restDensity, double c0) const override;
    double bulkModulus(double density, double restDensity, double c0) const override;
    double density(double pressure, double restDensity, double c0) const override;
};

}  // namespace corpuscle::sph
