// The predicted cost of each integrator for a case, from the case alone, and which one `integrator: automatic` takes:
// the cheapest of those that can be used for the case.
//
//     cost = passes of the whole run over its strain, or over its seconds if the flow has no shear rate
//
// A pass is one evaluation of the fluid's pair law for every particle. dt is the smallest limit of the step
// (sph/stepLimits.hpp), with the viscous rate of a lattice in place of power iterations, the speed of the flow in place
// of that of its particles, and an estimate of the membrane's spring rate.
//
//     integrator     | passes per step
//     velocityVerlet | 1, and 4 on adjoint operators
//     rkl2           | s + 1, with s the number of stages that dt needs
//     implicit       | 3.5 + 2 x its iterations
// The constants are measured (docs/theory/timeStep.md says how); a prediction is good to a factor of two.
#pragma once
#include <string>
#include <vector>

#include "schemes/numericsSettings.hpp"

namespace corpuscle::schemes {

struct IntegratorCost {
    std::string name;
    std::string whyNot;            // why it cannot be used for the case; empty: it can
    sph::StepLimits limits;        // of the step, half-way through the run
    double steps = 0, passes = 0;  // of the whole run
    double cost = 0;               // passes per unit of strain, or per second
    sph::StepLimit step() const { return limits.binding(); }
};

// One entry for each integrator.
std::vector<IntegratorCost> predictCosts(const NumericsSettings& written, const CaseFacts& facts);
// The name of the cheapest integrator that can be used for the case; empty if there is none.
std::string cheapest(const std::vector<IntegratorCost>& costs);

// Table of costs for checkCase and the log. integrator: the one taken; isChosen: it was chosen by its cost.
std::vector<std::string> costHeader(const CaseFacts& facts);
std::vector<std::vector<std::string>> costRows(const std::vector<IntegratorCost>& costs, const std::string& integrator,
                                               bool isChosen);

}  // namespace corpuscle::schemes
