#include "schemes/explicitLimits.hpp"

namespace corpuscle::schemes {

void addViscousLimit(const ExplicitRates& rates, double safety, sph::StepLimits& limits) {
    if (rates.viscous > 0)
        limits.add(
            "viscous", safety / rates.viscous,
            "the fluid is too viscous for an explicit step: take a coarser 'spacing' or 'integrator: implicit' in "
            "system/numerics.yaml");
}

void addOtherLimits(const ExplicitRates& rates, const ExplicitMedium& medium, double reach, sph::StepLimits& limits) {
    constexpr const char* stiff =
        "the membrane is too stiff for an explicit step: look for edges far below the spacing in 0/ (checkMesh), take "
        "a larger 'edge' in system/mesh.yaml, or 'integrator: implicit' in system/numerics.yaml";
    const double drag = rates.viscous + rates.membrane;
    if (rates.membrane > 0) limits.add("membrane viscosity", medium.safety / drag, stiff);
    limits.add("acoustic", reach * sph::acousticStep(medium.h, medium.soundAndFlow),
               "sound is too fast for the step: take a lower 'soundSpeed' in constant/fluid.yaml, or 'integrator: "
               "implicit' in system/numerics.yaml");
    if (medium.bodyForce > 0) limits.add("body force", sph::bodyForceStep(medium.h, medium.bodyForce));
    if (rates.spring2 > 0) limits.add("spring", medium.safety * sph::springStep(drag, rates.spring2), stiff);
}

}  // namespace corpuscle::schemes
