// What every step on adjoint operators (sph/operators.hpp) does alike, the explicit one (adjointVerlet.hpp) and the
// implicit one (implicit/implicitStep.hpp).
#pragma once
#include <optional>
#include <vector>

#include "coupling/scene.hpp"
#include "sph/operators.hpp"

namespace corpuscle::coupling {

struct AdjointOptions {
    sph::OperatorForm form = sph::OperatorForm::corrected;
    std::optional<double> shifting{};  // C, strength per unit of strain
    std::optional<DensityBalance> densityBalance{};
    long balanceInterval = 0;  // steps between two balances
    double largestBalance() const { return densityBalance ? densityBalance->largest() : 0; }
};

// Pressures of all owned particles by their densities [Pa].
void findPressures(const Scene& scene, particles::RealArray& pressure);

// At the end of a step, the number of which is given: density balance when it is due, then what breaks. Collective.
std::vector<RuptureEvent> endStep(Scene& scene, AdjointOptions& options, long number, double dt);

}  // namespace corpuscle::coupling
