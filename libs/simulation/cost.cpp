#include "simulation/cost.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/caseRules.hpp"
#include "simulation/scheme.hpp"

namespace corpuscle::simulation {

namespace {

// Largest eigenvalue of the viscous operator per mass [1/s].
double viscousRate(const Case& c) {
    double viscosity = c.viscosities().largest;
    for (const CellSettings& cell : c.mesh.cells)
        viscosity = std::max(viscosity, c.fluid.viscosity * c.membraneOf(cell).interior.viscosityRatio);
    const double dx = c.spacing();
    if (c.flow.walls.exist()) viscosity *= PassCosts::wallRate;
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

sph::StepLimits limitsOf(const Case& c, double t) {
    sph::StepLimits limits;
    if (c.numerics.isImplicit()) {
        limits.add("strain", c.numerics.implicit.step / c.flow.rate);
        return limits;
    }
    const double rate = viscousRate(c) / c.numerics.safety, h = 0.5 * c.support();
    if (c.numerics.isRkl2())
        c.numerics.rkl2.addLimits(c.flow, t, rate, limits);
    else
        limits.add("viscous", 1 / rate);
    limits.add("acoustic", (c.numerics.isRkl2() ? sph::Rkl2::acousticReach : 1) *
                               sph::acousticStep(h, c.soundSpeed() + c.flow.speed));
    if (!c.flow.bodyForce.isZero()) limits.add("body force", sph::bodyForceStep(h, c.flow.bodyForce.norm()));
    if (!c.mesh.cells.empty())
        limits.add("spring", c.numerics.safety * sph::springStep(viscousRate(c), springRate2(c)));
    return limits;
}

double passes(const Case& c, double dt) {
    if (c.numerics.isImplicit())
        return PassCosts::implicitOverhead +
               PassCosts::passesPerIteration * (c.mesh.cells.empty() && c.mesh.bodies.empty()
                                                    ? PassCosts::iterations
                                                    : PassCosts::iterationsWithin);
    if (c.numerics.isRkl2()) return sph::LegendreStages::needed(viscousRate(c) / c.numerics.safety * dt) + 1;
    return c.isConjugate() ? PassCosts::conjugate : 1;
}

// A step that does not follow what the flow does by itself.
std::string tooLong(const Case& c, double dt) {
    const double longest = longestStep(c.flow);
    if (!c.numerics.isImplicit() || longest == 0 || dt <= (1 + 1e-9) * longest) return "";
    return fmt::format("its steps do not follow the flow, which changes within {}; implicit.step at most {:.2g} would",
                       formatQuantity(c.flow.transient, unit::second), longest * c.flow.rate);
}

// Vortices that decay stir their particles, on which plain operators do not tend to the flow as the spacing falls.
std::string tooPlain(const Case& c) {
    const bool stirs = c.flow.transient > 0 && !c.flow.settles;
    if (!stirs || c.numerics.isCorrected() || c.written.operators != "automatic") return "";
    return "its plain operators lose accuracy on the particles of vortices; 'operators: plain' would take them";
}

// Steps and passes of the whole run. Steps grow at first where the flow settles, and are then as long as at its end.
void countPasses(const Case& c, IntegratorCost& cost) {
    const double end = duration(c), last = limitsOf(c, end).binding().seconds;
    double t = 0, dt = limitsOf(c, 0).binding().seconds;
    while (t < end && dt < last) {
        cost.steps += 1, cost.passes += passes(c, dt);
        t += dt;
        dt = limitsOf(c, t).binding().seconds;
    }
    const double rest = std::max(0.0, end - t) / last;
    cost.steps += rest, cost.passes += rest * passes(c, last);
}

}  // namespace

double duration(const Case& c) {
    return c.control.endTime ? *c.control.endTime : *c.control.endStrain / c.flow.shearRate;
}

std::vector<IntegratorCost> predictCosts(const Case& input) {
    std::vector<IntegratorCost> costs;
    for (const char* name : {"velocityVerlet", "rkl2", "implicit"}) {
        IntegratorCost& cost = costs.emplace_back();
        cost.name = name;
        cost.obstacle = obstacle(input, name);
        Case named = input;
        named.numerics = schemeOf(input, name);
        cost.limits = limitsOf(named, 0.5 * duration(input));
        countPasses(named, cost);
        cost.cost = cost.passes / duration(input) / (input.flow.shearRate > 0 ? input.flow.shearRate : 1);
        if (cost.obstacle.empty()) cost.obstacle = tooLong(named, cost.step().seconds);
        if (cost.obstacle.empty()) cost.obstacle = tooPlain(named);
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
    return {"integrator",
            "predicted step",
            "limited by",
            "passes a step",
            input.flow.shearRate > 0 ? "passes per unit of strain" : "passes per second",
            ""};
}

std::vector<std::vector<std::string>> costRows(const Case& input, const std::vector<IntegratorCost>& costs) {
    std::vector<std::vector<std::string>> rows;
    for (const IntegratorCost& cost : costs) {
        std::string note = cost.name != input.numerics.integrator ? ""
                           : input.integratorChosen               ? "taken"
                                                                  : "named by the case";
        if (!note.empty() && !cost.obstacle.empty()) note += ": ";
        note += cost.obstacle;
        rows.push_back({cost.name, formatQuantity(cost.step().seconds, unit::second), cost.step().name,
                        fmt::format("{:.3g}", cost.passes / cost.steps), fmt::format("{:.3g}", cost.cost), note});
    }
    return rows;
}

std::vector<std::string> limitHeader(const std::vector<IntegratorCost>& costs) {
    std::vector<std::string> header{"predicted limit of the step"};
    for (const IntegratorCost& cost : costs) header.push_back(cost.name);
    return header;
}

std::vector<std::vector<std::string>> limitRows(const std::vector<IntegratorCost>& costs) {
    std::vector<std::vector<std::string>> rows;
    for (std::size_t k = 0; k < costs.size(); ++k)
        for (const sph::StepLimit& limit : costs[k].limits.all) {
            auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r[0] == limit.name; });
            if (row == rows.end()) {
                row = rows.emplace(row, costs.size() + 1, "");
                row->front() = limit.name;
            }
            (*row)[k + 1] =
                formatQuantity(limit.seconds, unit::second) + (limit.name == costs[k].step().name ? " (binds)" : "");
        }
    return rows;
}

}  // namespace corpuscle::simulation
