// How long a step may be, by what the last one did.
//
// Places. The velocity found, v, differs from v0, the one extrapolated from the steps before, by the second difference
// of velocity, and from that of the step before, u, by the first, which is also what the local error of a step is made
// of: x is wrong by
//     dt |v - v0|/24 (midpoint),   dt |v - u|/2 (backward Euler)
// after a step. With E, this error over a length a and the strain of the step, the next one may be (error/E)^(1/2) as
// long, or error/E. Halves by backward Euler within a run by the midpoint rule are looked at as if they were of its
// kind, which the next step is.
//
// in the scene | the difference                                      | a
// cells        | of each the largest of its nodes; of these the root | radius of the sphere of the cell's volume
//              | mean square, a quarter of the largest at the least  |
// free bodies  | the largest of |dU| + a |dOmega|                    | the same of the body
// neither      | root mean square of the fluid                       | length of the flow (sph/flow.hpp)
// Steps of different length: the second difference is scaled to what it would be over steps as long as the last.
// Of one cell that is its largest; of many, the more of them there are, the largest is that of some rare event, and a
// step that follows it would be made by all.
// With cells and free bodies, the larger of both. A fluid beside them is not looked at: what moves them is what is
// asked for.
//
// Nothing is known of the error before the third step (the second, of a flow that starts fully developed), and the
// start from a velocity that does not know of the forces is of first order: where `error` is below its default, the
// first step is (error/default)^(1/2) as long as `step`, and the second twice that.
//
// What the solver leaves is in the difference as well, whatever the length of the step. In steps shorter than those of
// the case, where the extrapolated velocity is the better by the square of the length, its tolerance is the smaller by
// that much (toleranceShare); else such steps would shrink without end where many cells make it large.
//
// Contact. Nodes move to where the next step takes its forces before these act: no further than nine tenths of the way
// on which nothing meets.
//
// Bonds. No bond may change its length by more than bondStrain in one step: dt <= bondStrain/max |d/dt ln l|.
#pragma once
#include "coupling/immersed.hpp"
#include "implicit/implicitSettings.hpp"

namespace corpuscle::implicit {

struct AllowedSteps {
    double error = 0, bond = 0, contact = 0;  // [s]; 0: of any length
};

// Of the first step.
AllowedSteps firstStep(const ImplicitSettings& settings, double rate);

struct LastStep {
    double dt;       // its length [s]
    double planned;  // that which it would have had but for an event (core/time.hpp): from it the next one grows [s]
    bool backwardEuler;
    bool hasMembranes;
};
// difference: that of the last step over a [1/s]; 0: nothing is known of it. rate: of the flow; bondRate: largest of a
// bond [1/s].
AllowedSteps allowedSteps(const ImplicitSettings& settings, double rate, const LastStep& last, double difference,
                          double bondRate);

// Of the solver's tolerance in a step of this length, on a rate of the flow [1/s].
double toleranceShare(const ImplicitSettings& settings, double rate, double planned);

// Of two velocities of nodes, in radii of their cell [1/s]: of all cells of the scene. Collective.
double differenceOfCells(const coupling::Immersed& immersed, MPI_Comm comm, const coupling::Immersed::Vectors& a,
                         const coupling::Immersed::Vectors& b);

// Of the cells that this rank holds: the largest rate at which a bond's length changes, over its length [1/s].
double largestBondRate(const coupling::Immersed& immersed, const coupling::Immersed::Vectors& velocity);

}  // namespace corpuscle::implicit
