#include "coupling/adjoint.hpp"

#include <utility>

namespace corpuscle::coupling {

void findPressures(const Scene& scene, particles::RealArray& pressure) {
    const particles::ParticleStore& s = scene.store();
    const sph::FluidModel& model = scene.model();
    pressure.resize(s.size());
    model.equationOfState->specificPressure(s.density.data(), pressure.data(), static_cast<int>(s.size()),
                                            model.density, model.soundSpeed);
    for (std::size_t i = 0; i < s.size(); ++i) pressure[i] *= s.density[i] * s.density[i];
}

std::vector<RuptureEvent> endStep(Scene& scene, AdjointOptions& options, long number, double dt) {
    if (options.densityBalance && number % options.balanceInterval == 0)
        options.densityBalance->apply(*scene.system, scene.cells);
    std::vector<RuptureEvent> events;
    for (Cell& cell : scene.cells) {
        if (!cell.membrane.canRupture()) continue;
        std::vector<membrane::BrokenBond> broken = cell.membrane.findBroken(dt);
        if (broken.empty()) continue;
        const bool counts = scene.budget.kept && cell.isOwnedBy(scene.system->decomposition().rank());
        const double before = counts ? cell.membrane.energy() : 0;
        broken = cell.membrane.breakBonds(std::move(broken));
        if (counts) scene.budget.total[sph::Budget::released] += before - cell.membrane.energy();
        events.push_back({cell.membrane.cell, std::move(broken)});
    }
    return events;
}

}  // namespace corpuscle::coupling
