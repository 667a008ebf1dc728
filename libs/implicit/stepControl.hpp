// How long a step may be, by what the last one did to the membranes.
//
// Places. The velocity of nodes found, v, differs from the one extrapolated from the steps before, v0, by the second difference of velocity
// (first with backward Euler), which is also what the local error of a step is made of: x is wrong by
//     dt |v - v0|/24 (midpoint),   dt |v - v0|/2 (backward Euler)
// after a step. With e the largest of it over radius and strain of the step, the next one may be (error/e)^(1/2) as long, or error/e.
//
// Nothing is known of the error before the third step, and the start from a velocity that does not know of the forces is of first order: where `error`
// is below its default, the first step is (error/default)^(1/2) as long as `step`, and the second twice that.
//
// Bonds. No bond may change its length by more than bondStrain in one step: dt <= bondStrain/max |d/dt ln l|.
#pragma once
#include "coupling/immersed.hpp"
#include "coupling/scene.hpp"
#include "implicit/implicitSettings.hpp"

namespace corpuscle::implicit {

struct AllowedSteps {
    double error = 0, bond = 0;  // [s]; 0: of any length
};

// Of the first step.
AllowedSteps firstStep(const ImplicitSettings& settings, double rate);

// Of velocities of all nodes, found and extrapolated; where these are the same, nothing is known of the error.
AllowedSteps allowedSteps(const ImplicitSettings& settings, const coupling::Scene& scene, double dt, bool backwardEuler,
                          const coupling::Immersed::Vectors& found, const coupling::Immersed::Vectors& extrapolated);

// Largest rate at which a bond's length changes, over its length [1/s].
double largestBondRate(const std::vector<coupling::Cell>& cells, const coupling::Immersed::Vectors& velocity);

}  // namespace corpuscle::implicit
