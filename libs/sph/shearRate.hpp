// The rate of a simple shear as a case gives it, and the density that may follow from it:
//     gammadot = Ca Gs/(mu a),   rho = Re mu/(gammadot a^2)
#pragma once
#include "sph/flow.hpp"

namespace corpuscle::sph {

struct ShearRate {
    std::optional<double> Ca, shearRate;
    std::optional<InertiaSettings> inertia;  // empty: physical
    static const Schema<ShearRate>& schema();

    // shearRate, rate, density and densityFromRe of the flow; else problems.
    void resolveRate(const FlowContext& context, const Mark& mark, Problems& problems, FlowState& flow) const;
};

}  // namespace corpuscle::sph
