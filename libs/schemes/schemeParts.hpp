// What several schemes have in common.
#pragma once
#include "coupling/adjoint.hpp"
#include "schemes/explicitLimits.hpp"
#include "schemes/numericsSettings.hpp"

namespace corpuscle::schemes {

inline const Mark numericsFile{"system/numerics.yaml", 0, 0};

// The rates of a case: the viscous one of a lattice, beside walls up to 1.3 times as large.
ExplicitRates predictedRates(const CaseFacts& facts, const NumericsSettings& numerics);
ExplicitMedium predictedMedium(const CaseFacts& facts, const NumericsSettings& numerics, double soundSpeed);

// Those of velocity Verlet, of these.
sph::StepLimits verletLimits(const CaseFacts& facts, const NumericsSettings& numerics, double soundSpeed);

// The volume and density that density is balanced against (coupling/densityBalance.hpp).
coupling::DensityBalance densityBalance(const coupling::Scene& scene);
coupling::AdjointOptions adjointOptions(const NumericsSettings& numerics, const coupling::Scene& scene);

// What corrected operators and jumps of viscosity ask for where operators are adjoint.
void checkShifting(const NumericsSettings& numerics, Problems& problems);
void checkJumps(const CaseFacts& facts, const NumericsSettings& numerics, Problems& problems);

// The guard looks at nothing where nodes are no particles.
Scheme::UnusedKey unusedGuard();

}  // namespace corpuscle::schemes
