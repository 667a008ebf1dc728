#include "sph/shearRate.hpp"

namespace corpuscle::sph {

const Schema<ShearRate>& ShearRate::schema() {
    static const Schema<ShearRate> s =
        Schema<ShearRate>("shear rate", "rate of a simple shear")
            .quantity("Ca", &ShearRate::Ca, unit::none,
                      "capillary number mu gammadot a/Gs, Gs the in-plane laws' closed form", {.range = positive})
            .quantity("shearRate", &ShearRate::shearRate, unit::perSecond, "shear rate gammadot", {.range = positive})
            .exactlyOneOf({"Ca", "shearRate"})
            .tableOr("physical", "inertia", &ShearRate::inertia, "density as given, or set by a Reynolds number",
                     {.fallback = "physical"})
            .atRestart(AtRestart::noted, {"Ca", "shearRate"})
            .atRestart(AtRestart::resolved, {"inertia"});
    return s;
}

void ShearRate::resolveRate(const FlowContext& context, const Mark& mark, Problems& problems, FlowState& flow) const {
    if (Ca && context.shearModulus <= 0)
        problems.add(mark, "Ca",
                     "a capillary number needs a membrane, and the case has none; give shearRate, or cells in "
                     "system/mesh.yaml and their laws in constant/membranes.yaml");
    if (inertia && context.radius <= 0)
        problems.add(mark, "inertia",
                     "Re = rho gammadot a^2/mu needs the radius a of a cell or a rigid body, and the case has neither; "
                     "write inertia: "
                     "physical and give the density in constant/fluid.yaml");
    if (!problems.empty()) return;
    flow.shearRate = Ca ? *Ca * context.shearModulus / (context.viscosity * context.radius) : *shearRate;
    flow.density = inertia ? inertia->Re * context.viscosity / (flow.shearRate * context.radius * context.radius)
                           : context.density;
    flow.densityFromRe = inertia.has_value();
    flow.rate = flow.shearRate;
}

}  // namespace corpuscle::sph
