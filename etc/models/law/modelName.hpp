// Bond law `modelName`:
//     E = k/2 (l - l0)^2         F_i = -k (l - l0) e,   e = (x_i - x_j)/l
// symbol | meaning                    | unit
// k      | spring constant            | N/m
// l0     | rest length, from the mesh | m
// On a hexagonal network: Gs = sqrt(3)/4 k, Ks = sqrt(3)/2 k.
// Source:
#pragma once
#include "core/settings.hpp"
#include "membrane/bondLaw.hpp"

namespace corpuscle::membrane {

struct ModelName : BondLawOf<ModelName> {
    double k = 0;
    double energy(double l, double l0) const { return 0.5 * k * (l - l0) * (l - l0); }
    double derivative(double l, double l0) const { return k * (l - l0); }
    double secondDerivative(double /*l*/, double /*l0*/) const { return k; }
    std::string constants(double l0) const override;
    static const Schema<ModelName>& schema();
};

}  // namespace corpuscle::membrane
