// What the two steps with adjoint operators (sph/operators.hpp) have in common: the explicit step (adjointVerlet.hpp)
// and the implicit step (implicit/implicitStep.hpp).
#pragma once
#include <optional>
#include <vector>

#include "coupling/scene.hpp"
#include "sph/operators.hpp"

namespace corpuscle::coupling {

struct AdjointOptions {
    sph::OperatorForm form = sph::OperatorForm::corrected;
    std::optional<double> shifting{};  // C of transport.hpp: strength per unit of strain; empty: no shifting
    std::optional<DensityBalance> densityBalance{};
    long balanceInterval = 0;  // steps between two balances
    double largestBalance() const { return densityBalance ? densityBalance->largest() : 0; }
};

// Pressures of all owned particles from their densities [Pa].
void findPressures(const Scene& scene, particles::RealArray& pressure);

// Ends step `number`, of length dt [s]: applies the density balance if it is due, then breaks bonds. Returns the bonds
// that broke. Collective.
std::vector<RuptureEvent> endStep(Scene& scene, AdjointOptions& options, long number, double dt);

}  // namespace corpuscle::coupling
