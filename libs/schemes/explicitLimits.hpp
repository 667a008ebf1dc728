// The limits of an explicit step (sph/stepLimits.hpp), from rates that are measured in a run or predicted for a case.
#pragma once
#include "sph/stepLimits.hpp"

namespace corpuscle::schemes {

struct ExplicitRates {
    double viscous = 0;   // largest rate of the viscous operator [1/s]
    double membrane = 0;  // of the viscosity of the membranes themselves [1/s]
    double spring2 = 0;   // of the membranes' stiffness [1/s^2]
};

// Other quantities that limit a step.
struct ExplicitMedium {
    double h = 0;             // smoothing length: half of the kernel's support [m]
    double soundAndFlow = 0;  // speed of sound + the largest speed [m/s]
    double bodyForce = 0;     // the largest at any time [m/s^2]
    double safety = 1;
};

void addViscousLimit(const ExplicitRates& rates, double safety, sph::StepLimits& limits);
// Limits by sound, body force and membranes. reach: acoustic limit of the scheme over that of velocity Verlet.
void addOtherLimits(const ExplicitRates& rates, const ExplicitMedium& medium, double reach, sph::StepLimits& limits);

}  // namespace corpuscle::schemes
