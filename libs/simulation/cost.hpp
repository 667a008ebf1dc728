// What each integrator would cost on a case, predicted from the case alone, and which one `integrator: automatic` takes: the cheapest
// of those that can do the case.
//
//     cost = passes of the whole run over its strain, or over its seconds where the flow has no shear rate
//
// A pass is one evaluation of the fluid's pair law for every particle. dt is the smallest limit of the step (sph/stepLimits.hpp), with the
// viscous rate of a lattice in place of power iterations, the speed of the flow in place of that of its particles, and an estimate of
// the membrane's spring rate.
//
//     integrator     | passes per step
//     velocityVerlet | 1, and 4 on conjugate operators (coupling/conjugateVerlet.hpp)
//     rkl2           | s + 1, s the stages that dt needs
//     implicit       | implicitOverhead + passesPerIteration x its iterations
// Measured constants (docs/theory/timeStep.md says how); a prediction is good to a factor of two.
#pragma once
#include <string>
#include <vector>

#include "simulation/case.hpp"
#include "sph/stepLimits.hpp"

namespace corpuscle::simulation {

struct PassCosts {
    static constexpr double conjugate = 4;  // velocity Verlet on conjugate operators
    static constexpr double implicitOverhead = 3.5, passesPerIteration = 2;
    static constexpr double iterations = 4, iterationsWithin = 12;  // of the implicit step; with cells or bodies
    static constexpr double wallRate = 1.3;  // largest viscous rate beside walls over that of a lattice
};

struct IntegratorCost {
    std::string name;
    std::string obstacle;          // why the case cannot use it; empty: it can
    sph::StepLimits limits;        // of the step, half-way through the run
    double steps = 0, passes = 0;  // of the whole run
    double cost = 0;               // passes per unit of strain, or per second
    sph::StepLimit step() const { return limits.binding(); }
};

double duration(const Case& input);  // of the whole run [s]

// One entry for each integrator, in the order of the table above.
std::vector<IntegratorCost> predictCosts(const Case& input);
// The name of the cheapest that the case can use; empty where there is none.
std::string cheapest(const std::vector<IntegratorCost>& costs);

// For checkCase and the log.
std::vector<std::string> costHeader(const Case& input);
std::vector<std::vector<std::string>> costRows(const Case& input, const std::vector<IntegratorCost>& costs);
// All predicted limits of the step, one row each, a column for each integrator.
std::vector<std::string> limitHeader(const std::vector<IntegratorCost>& costs);
std::vector<std::vector<std::string>> limitRows(const std::vector<IntegratorCost>& costs);

}  // namespace corpuscle::simulation
