#include "sph/tait.hpp"

#include <cmath>

namespace corpuscle::sph {

const Schema<Tait>& Tait::schema() {
    static const Schema<Tait> s =
        Schema<Tait>("tait", "p = rho0 c0^2/gamma ((rho/rho0)^gamma - 1)")
            .quantity("gamma", &Tait::gamma, unit::none, "exponent", {.fallback = "7", .range = positive})
            .quantityOr("auto", "soundSpeed", &Tait::soundSpeed, unit::metrePerSecond, "sound speed c0",
                        {.fallback = "auto", .range = positive});
    return s;
}

void Tait::specificPressure(const double* density, double* out, int n, double restDensity, double c0) const {
    const double scale = restDensity * c0 * c0 / gamma, inverse = 1 / restDensity;
    if (gamma == 7) {
        for (int i = 0; i < n; ++i) {
            const double q = density[i] * inverse, q3 = q * q * q;
            out[i] = scale * (q3 * q3 * q - 1) / (density[i] * density[i]);
        }
        return;
    }
    for (int i = 0; i < n; ++i)
        out[i] = scale * (std::pow(density[i] * inverse, gamma) - 1) / (density[i] * density[i]);
}

double Tait::pressure(double density, double restDensity, double c0) const {
    return restDensity * c0 * c0 / gamma * (std::pow(density / restDensity, gamma) - 1);
}

double Tait::energy(double density, double restDensity, double c0) const {
    const double q = density / restDensity,
                 bulk = gamma == 1 ? std::log(q) : (std::pow(q, gamma - 1) - 1) / (gamma - 1);
    return c0 * c0 / gamma * (bulk + 1 / q - 1);
}

double Tait::bulkModulus(double density, double restDensity, double c0) const {
    return restDensity * c0 * c0 * std::pow(density / restDensity, gamma);
}

double Tait::density(double pressure, double restDensity, double c0) const {
    return restDensity * std::pow(1 + pressure * gamma / (restDensity * c0 * c0), 1 / gamma);
}

CORPUSCLE_REGISTER(EquationOfState, Tait, "tait", "stiff power law of weakly compressible SPH");

}  // namespace corpuscle::sph
