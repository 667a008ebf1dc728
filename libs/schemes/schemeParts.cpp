#include "schemes/schemeParts.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace corpuscle::schemes {

namespace {
constexpr double wallRate = 1.3;            // largest viscous rate beside walls over that of a lattice
constexpr double furthestViscosities = 20;  // largest ratio of viscosities (sph/operators.hpp)

// Over the box, by the largest force that drives the flow [Pa].
double pressureDrop(const coupling::Scene& scene) {
    return scene.model().density * scene.flow.largestForce() * scene.fluidBox.size()[0];
}

// The lower the pressure behind a throat, the faster densities have to follow the number of particles: in a sinusoidal
// tube where drop/(mu gammadot) is 22, with 10 all sigma stay above 0.97, and 1 and 2.2 leave a void. Beside cells this
// adds noise, and in folds and films, where sigma stays away from 1, densities grow until the run ends.
double automaticDensityRate(const coupling::Scene& scene) {
    constexpr double share = 0.5, least = 1, most = 10;
    const sph::FlowState& flow = scene.flow;
    if (!flow.varies || flow.rate == 0 || scene.cells.exist()) return 0;
    return std::clamp(share * pressureDrop(scene) / (scene.model().viscosity * flow.rate), least, most);
}

// A cell that fills a throat takes up nearly all of the pressure drop: the pressure is lower by half of the drop than
// on average behind it, and higher by the same before it.
double automaticBackgroundPressure(const coupling::Scene& scene) {
    constexpr double share = 2.0 / 3;
    return scene.flow.varies && scene.cells.exist() ? share * pressureDrop(scene) : 0;
}
}  // namespace

ExplicitRates predictedRates(const CaseFacts& facts, const NumericsSettings& numerics) {
    const double dx = numerics.spacing;
    double viscosity = facts.mostViscous;
    if (facts.flow.walls.exist()) viscosity *= wallRate;
    return {numerics.kernel->viscousRate(numerics.support() / dx) * viscosity / (facts.flow.density * dx * dx), 0,
            facts.springRate2};
}

ExplicitMedium predictedMedium(const CaseFacts& facts, const NumericsSettings& numerics, double soundSpeed) {
    return {0.5 * numerics.support(), soundSpeed + facts.flow.speed, facts.flow.largestForce(), numerics.safety};
}

sph::StepLimits verletLimits(const CaseFacts& facts, const NumericsSettings& numerics, double soundSpeed) {
    const ExplicitRates rates = predictedRates(facts, numerics);
    sph::StepLimits limits;
    addViscousLimit(rates, numerics.safety, limits);
    addOtherLimits(rates, predictedMedium(facts, numerics, soundSpeed), 1, limits);
    return limits;
}

coupling::DensityBalance densityBalance(const coupling::Scene& scene) {
    double volume = scene.fluidVolume;
    if (scene.bodies)
        for (const bodies::Body& body : scene.bodies->all())
            if (body.cell == 0) volume -= body.solid.volume;
    return {volume, scene.model().density, scene.model().mass};
}

coupling::AdjointOptions adjointOptions(const NumericsSettings& numerics, const coupling::Scene& scene) {
    coupling::AdjointOptions options;
    if (!numerics.isCorrected()) options.form = sph::OperatorForm::plain;
    if (numerics.shifting) {
        options.shifting = numerics.shifting->coefficient;
        options.densityRate = numerics.shifting->densityRate.value_or(automaticDensityRate(scene));
        options.backgroundPressure = numerics.shifting->backgroundPressure.value_or(automaticBackgroundPressure(scene));
    }
    options.balanceInterval = numerics.balanceInterval();
    if (options.balanceInterval > 0) options.densityBalance = densityBalance(scene);
    return options;
}

void checkShifting(const NumericsSettings& numerics, Problems& problems) {
    if (numerics.isCorrected() && !numerics.shifting)
        problems.add(numericsFile, "operators",
                     "found corrected, which let particles clump without shifting; write 'shifting: {coefficient: 1}' "
                     "beside it, or operators: plain");
}

void checkJumps(const CaseFacts& facts, const NumericsSettings& numerics, Problems& problems) {
    const double least = facts.leastViscosity, largest = facts.largestViscosity;
    if (largest <= furthestViscosities * least * (1 + 1e-9)) return;
    problems.add({"constant/fluid.yaml", 0, 0}, "layers",
                 fmt::format("found viscosities from {} to {}; the operators of 'integrator: {}' with 'operators: {}' "
                             "keep motion bounded at a jump of at most {:g}: bring them nearer, or take 'integrator: "
                             "velocityVerlet' with 'operators: plain' in system/numerics.yaml",
                             formatQuantity(least, unit::pascalSecond), formatQuantity(largest, unit::pascalSecond),
                             numerics.integrator, numerics.operators, furthestViscosities));
}

std::vector<Scheme::UnusedKey> unusedShifting() {
    return {{"shifting.densityRate", "with plain operators, where densities follow the continuity equation alone"},
            {"shifting.backgroundPressure", "with this integrator"}};
}

Scheme::UnusedKey unusedGuard() {
    return {"guard", "with 'coupling: immersed', where particles are held to their side at every step"};
}

}  // namespace corpuscle::schemes
