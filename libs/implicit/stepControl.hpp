// Largest permissible length of the next step, from the last one.
//
// Positions. The computed velocity v differs from v0, extrapolated from the steps before, by the second difference of
// the velocity in time, and from u, that of the step before, by the first difference. The local error of a step
// consists of the same differences: after a step, x is wrong by
//     dt |v - v0|/24 (midpoint),   dt |v - u|/2 (backward Euler)
// Let E be this error divided by a length a and by the strain of the step. The next step may then be (error/E)^(1/2)
// times as long (midpoint), or error/E times (backward Euler). Half steps by backward Euler within a run by the
// midpoint rule are treated like midpoint steps, because the next step is one.
//
// in the scene | the difference                                      | a
// cells        | of each cell the largest of its nodes; over the     | radius of the sphere of the cell's volume
//              | cells the root mean square, but not less than a     |
//              | quarter of the largest                              |
// free bodies  | the largest of |dU| + a |dOmega|                    | the same of the body
// neither      | root mean square of the fluid                       | length of the flow (sph/flow.hpp)
// If steps have different lengths, the second difference is scaled to the value over steps as long as the last. For one
// cell the mean over cells is its largest difference. Among many cells the largest difference is that of a rare event,
// the more so the more cells there are, and all cells would have to follow it with short steps. With cells and free
// bodies, the larger of both differences counts. Fluid beside them is not considered: only the motion of cells and
// bodies matters.
//
// There is no estimate of the error before the third step (the second, if the flow starts fully developed), and the
// start from a velocity that does not include the effect of the forces is of first order. Where `error` is below its
// default, the first step is therefore limited to (error/default)^(1/2) of `step`, and the second to twice that.
//
// The difference also contains the error of the solver, which does not decrease with the step. In steps shorter than
// those of the case, the extrapolated velocity is more accurate by the square of the length, and the tolerance of the
// solver is reduced by the same factor (toleranceShare). Otherwise such steps would shrink without end where many cells
// make the difference large.
//
// Contact. Nodes move to the positions where the next step evaluates its forces before these forces act. They may move
// at most nine tenths of the way on which nothing meets.
//
// Breaks. After a break the next one is often near, and the velocity changes as fast as the membrane around the hole
// relaxes. The step after a break is at most twice as long as the time between the last two breaks; each step in which
// nothing breaks doubles this limit, and one that was shortened because damage grew sets it to twice its length. Where
// cells can break, the first step is at most a strain of 0.0125, because a break early in a run comes too early by up
// to 2 % of its strain if the start of the flow is passed over in one step of 0.1.
//
// Bonds. No bond may change its length by more than bondStrain in one step: dt <= bondStrain/max |d/dt ln l|.
#pragma once
#include "coupling/immersed.hpp"
#include "implicit/implicitSettings.hpp"

namespace corpuscle::implicit {

constexpr double startOfRupture = 0.0125;  // strain of the first step where cells can break

struct AllowedSteps {
    double error = 0, bond = 0, contact = 0, breaks = 0;  // by each criterion [s]; 0: of any length
};

// Limits of the first step.
AllowedSteps firstStep(const ImplicitSettings& settings, double rate);

struct LastStep {
    double dt;       // its length [s]
    double planned;  // without an event that shortens it (core/time.hpp): the next step grows from it [s]
    bool backwardEuler;
    bool hasMembranes;
};
// difference: that of the last step divided by a [1/s]; 0: not known. rate: of the flow [1/s]; bondRate: largest rate
// |d/dt ln l| of a bond [1/s].
AllowedSteps allowedSteps(const ImplicitSettings& settings, double rate, const LastStep& last, double difference,
                          double bondRate);

// Factor of the solver's tolerance in a step of the length `planned` [s]. rate: of the flow [1/s].
double toleranceShare(const ImplicitSettings& settings, double rate, double planned);

// Difference of two velocities of the nodes, in radii of their cell, over all cells of the scene [1/s]. Collective.
double differenceOfCells(const coupling::Immersed& immersed, MPI_Comm comm, const coupling::Immersed::Vectors& a,
                         const coupling::Immersed::Vectors& b);

// Largest rate |d/dt ln l| of a bond, among the cells that this rank holds [1/s].
double largestBondRate(const coupling::Immersed& immersed, const coupling::Immersed::Vectors& velocity);

}  // namespace corpuscle::implicit
