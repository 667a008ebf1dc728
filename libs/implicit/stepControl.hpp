// How long a step may be, by what the last one did.
//
// Places. The velocity found, v, differs from the one extrapolated from the steps before, v0, by the second difference of velocity
// (first with backward Euler), which is also what the local error of a step is made of: x is wrong by
//     dt |v - v0|/24 (midpoint),   dt |v - v0|/2 (backward Euler)
// after a step. With e of it over a length a and the strain of the step, the next one may be (error/e)^(1/2) as long, or error/e.
//
// in the scene | |v - v0|                                            | a
// cells        | the largest of the nodes                            | radius of the sphere of the cell's volume
// bodies       | the largest of the free ones, |dU| + a |dOmega|     | the same of the body
// neither      | root mean square of the fluid                       | length of the flow (sph/flow.hpp)
// A fluid beside cells or bodies is not looked at: what moves them is what is asked for.
//
// Nothing is known of the error before the third step, and the start from a velocity that does not know of the forces is of first order: where `error`
// is below its default, the first step is (error/default)^(1/2) as long as `step`, and the second twice that.
//
// Bonds. No bond may change its length by more than bondStrain in one step: dt <= bondStrain/max |d/dt ln l|.
#pragma once
#include "coupling/immersed.hpp"
#include "implicit/implicitSettings.hpp"

namespace corpuscle::implicit {

struct AllowedSteps {
    double error = 0, bond = 0;  // [s]; 0: of any length
};

// Of the first step.
AllowedSteps firstStep(const ImplicitSettings& settings, double rate);

// difference: |v - v0|/a of the last step of dt [1/s]; 0: nothing is known of it. rate: of the flow; bondRate: largest of a bond [1/s].
AllowedSteps allowedSteps(const ImplicitSettings& settings, double rate, double dt, bool backwardEuler,
                          double difference, double bondRate);

// Largest difference of two velocities of all nodes, in radii of their cell [1/s].
double largestDifference(const std::vector<coupling::Cell>& cells, const coupling::Immersed::Vectors& a,
                         const coupling::Immersed::Vectors& b);

// Largest rate at which a bond's length changes, over its length [1/s].
double largestBondRate(const std::vector<coupling::Cell>& cells, const coupling::Immersed::Vectors& velocity);

}  // namespace corpuscle::implicit
