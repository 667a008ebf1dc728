#include "sph/linear.hpp"

#include <cmath>

namespace corpuscle::sph {

const Schema<Linear>& Linear::schema() {
    static const Schema<Linear> s = Schema<Linear>("linear", "p = c0^2 (rho - rho0)")
                                        .quantityOr("auto", "soundSpeed", &Linear::soundSpeed, unit::metrePerSecond,
                                                    "sound speed c0", {.fallback = "auto", .range = positive});
    return s;
}

void Linear::specificPressure(const double* density, double* out, int n, double restDensity, double c0) const {
    for (int i = 0; i < n; ++i) out[i] = c0 * c0 * (density[i] - restDensity) / (density[i] * density[i]);
}

double Linear::pressure(double density, double restDensity, double c0) const {
    return c0 * c0 * (density - restDensity);
}

double Linear::energy(double density, double restDensity, double c0) const {
    const double q = density / restDensity;
    return c0 * c0 * (std::log(q) + 1 / q - 1);
}

double Linear::bulkModulus(double density, double, double c0) const { return c0 * c0 * density; }

double Linear::density(double pressure, double restDensity, double c0) const {
    return restDensity + pressure / (c0 * c0);
}

CORPUSCLE_REGISTER(EquationOfState, Linear, "linear", "pressure proportional to the excess of density");

}  // namespace corpuscle::sph
