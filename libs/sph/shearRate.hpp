// The rate of a simple shear as given by a case, and the density that follows from it if the case gives Re:
//     gammadot = Ca Gs/(mu a),   rho = Re mu/(gammadot a^2)
#pragma once
#include "sph/flow.hpp"

namespace corpuscle::sph {

struct ShearRate {
    std::optional<double> Ca, shearRate;
    std::optional<InertiaSettings> inertia;  // empty: physical
    static const Schema<ShearRate>& schema();

    // Sets shearRate, rate, density and densityFromRe of the flow, or adds problems.
    void resolveRate(const FlowContext& context, const Mark& mark, Problems& problems, FlowState& flow) const;
};

}  // namespace corpuscle::sph
