#include "simulation/cost.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/caseRules.hpp"

namespace corpuscle::simulation {

namespace {

// In words, from the rules between files; empty where the case may name it. Only what the integrator is to blame for.
std::string ruledOut(const Case& input, const std::string& integrator) {
    Case named = input;
    named.numerics.integrator = integrator;
    Problems problems;
    checkScheme(named, problems);
    return problems.empty() ? "" : problems.first().reason();
}

// Largest eigenvalue of the viscous operator per mass on a lattice [1/s].
double viscousRate(const Case& c) {
    double viscosity = c.fluid.viscosity;
    for (const CellSettings& cell : c.mesh.cells)
        viscosity = std::max(viscosity, c.fluid.viscosity * c.membraneOf(cell).interior.viscosityRatio);
    const double dx = c.spacing();
    return c.numerics.kernel->viscousRate(c.support() / dx) * viscosity / (c.flow.density * dx * dx);
}

// Of M^-1 K for a hexagonal network of nodes on the membrane [1/s^2]: 6 k/m, its bonds of stiffness k = (Gs + Ks) 4/(3 sqrt(3)), the mass
// of a node that of its hexagon, one spacing thick. Bending is left out.
double springRate2(const Case& c) {
    double most = 0;
    for (const CellSettings& cell : c.mesh.cells) {
        const membrane::SurfaceModuli moduli = c.membraneOf(cell).moduli(cell.edge);
        const double bond = (moduli.shear + moduli.area) * 4 / (3 * std::numbers::sqrt3),
                     mass = c.flow.density * c.spacing() * std::numbers::sqrt3 / 2 * cell.edge * cell.edge;
        most = std::max(most, 6 * bond / mass);
    }
    return most;
}

sph::StepLimits limitsOf(const Case& c) {
    sph::StepLimits limits;
    if (c.numerics.isImplicit()) {
        limits.add("accuracy", c.numerics.implicit.step / c.flow.rate);
        return limits;
    }
    const double rate = viscousRate(c) / c.numerics.safety, h = 0.5 * c.support();
    if (c.numerics.isRkl2())
        sph::addLimits(c.numerics.rkl2, rate, c.flow.transient, limits);
    else
        limits.add("viscous", 1 / rate);
    limits.add("acoustic", sph::acousticStep(h, c.soundSpeed() + c.flow.speed));
    if (!c.flow.bodyForce.isZero()) limits.add("body force", sph::bodyForceStep(h, c.flow.bodyForce.norm()));
    if (!c.mesh.cells.empty())
        limits.add("spring", c.numerics.safety * sph::springStep(viscousRate(c), springRate2(c)));
    return limits;
}

double passes(const Case& c, double dt) {
    if (c.numerics.isImplicit())
        return PassCosts::implicitOverhead + PassCosts::implicitIterations * PassCosts::passesPerIteration;
    return c.numerics.isRkl2() ? sph::LegendreStages::needed(viscousRate(c) / c.numerics.safety * dt) + 1 : 1;
}

// The step of the case is an order too long for what it does between rest and its end.
std::string tooLong(const Case& c, double dt) {
    const double longest = c.flow.transient / PassCosts::implicitStepsPerTransient;
    if (!c.numerics.isImplicit() || c.flow.transient == 0 || dt <= longest) return "";
    return fmt::format("steps of {} pass over what the flow does from its start, in {}; implicit.step up to {:.2g} would not",
                       formatQuantity(dt, unit::second), formatQuantity(c.flow.transient, unit::second),
                       longest * c.flow.rate);
}

}  // namespace

std::vector<IntegratorCost> predictCosts(const Case& input) {
    std::vector<IntegratorCost> costs;
    for (const char* name : {"velocityVerlet", "rkl2", "implicit"}) {
        IntegratorCost& cost = costs.emplace_back();
        cost.name = name;
        cost.obstacle = ruledOut(input, name);
        Case named = input;
        named.numerics.integrator = name;
        cost.step = limitsOf(named).binding();
        cost.passes = passes(named, cost.step.seconds);
        cost.cost = cost.passes / cost.step.seconds / (input.flow.shearRate > 0 ? input.flow.shearRate : 1);
        if (cost.obstacle.empty()) cost.obstacle = tooLong(named, cost.step.seconds);
    }
    return costs;
}

std::string cheapest(const std::vector<IntegratorCost>& costs) {
    const IntegratorCost* least = nullptr;
    for (const IntegratorCost& cost : costs)
        if (cost.obstacle.empty() && (!least || cost.cost < least->cost)) least = &cost;
    return least ? least->name : "";
}

std::vector<std::string> costHeader(const Case& input) {
    return {"integrator", "step", "limited by", "passes a step",
            input.flow.shearRate > 0 ? "passes per unit of strain" : "passes per second", ""};
}

std::vector<std::vector<std::string>> costRows(const Case& input) {
    std::vector<std::vector<std::string>> rows;
    for (const IntegratorCost& cost : predictCosts(input)) {
        std::string note = cost.obstacle;
        if (cost.name == input.numerics.integrator)
            note = (input.integratorChosen ? "taken" : "named by the case") + (note.empty() ? "" : ": " + note);
        rows.push_back({cost.name, formatQuantity(cost.step.seconds, unit::second), cost.step.name,
                        fmt::format("{:.3g}", cost.passes), fmt::format("{:.3g}", cost.cost), note});
    }
    return rows;
}

}  // namespace corpuscle::simulation
