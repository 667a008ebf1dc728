// What several schemes have in common.
#pragma once
#include "coupling/adjoint.hpp"
#include "schemes/explicitLimits.hpp"
#include "schemes/numericsSettings.hpp"

namespace corpuscle::schemes {

inline const Mark numericsFile{"system/numerics.yaml", 0, 0};

// Predicted rates of a case. The viscous rate is that of a lattice; with walls 1.3 times as large, its upper bound
// there.
ExplicitRates predictedRates(const CaseFacts& facts, const NumericsSettings& numerics);
ExplicitMedium predictedMedium(const CaseFacts& facts, const NumericsSettings& numerics, double soundSpeed);

// Predicted limits of a velocity Verlet step, from these rates.
sph::StepLimits verletLimits(const CaseFacts& facts, const NumericsSettings& numerics, double soundSpeed);

// The volume and the density against which densities are balanced (coupling/densityBalance.hpp).
coupling::DensityBalance densityBalance(const coupling::Scene& scene);
coupling::AdjointOptions adjointOptions(const NumericsSettings& numerics, const coupling::Scene& scene);

// Checks what corrected operators and jumps of viscosity require of schemes with adjoint operators.
void checkShifting(const NumericsSettings& numerics, Problems& problems);
void checkJumps(const CaseFacts& facts, const NumericsSettings& numerics, Problems& problems);

// The leakage guard has nothing to do where membrane nodes are not particles.
Scheme::UnusedKey unusedGuard();
// Plain operators leave densities to the continuity equation.
std::vector<Scheme::UnusedKey> unusedShifting();

}  // namespace corpuscle::schemes
