#include "coupling/adjoint.hpp"

#include <utility>

#include "coupling/rupture.hpp"

namespace corpuscle::coupling {

void findPressures(const Scene& scene, double background, particles::RealArray& pressure) {
    const particles::ParticleStore& s = scene.store();
    const sph::FluidModel& model = scene.model();
    pressure.resize(s.size());
    model.equationOfState->specificPressure(s.density.data(), pressure.data(), static_cast<int>(s.size()),
                                            model.density, model.soundSpeed);
    for (std::size_t i = 0; i < s.size(); ++i) pressure[i] = background + pressure[i] * s.density[i] * s.density[i];
}

std::vector<RuptureEvent> endStep(Scene& scene, AdjointOptions& options, long number, double dt) {
    if (options.densityBalance && number % options.balanceInterval == 0)
        options.densityBalance->apply(*scene.system, scene.cells);
    if (scene.solute) scene.solute->arrive(scene.cells);
    std::vector<RuptureEvent> events;
    for (Cell& cell : scene.cells) {
        if (!cell.membrane.canRupture()) continue;
        const bool counts = scene.budget.kept && cell.isOwnedBy(scene.system->decomposition().rank());
        RuptureEvent event = rupture(cell.membrane, dt, counts ? &scene.budget : nullptr);
        if (!event.bonds.empty()) events.push_back(std::move(event));
    }
    return events;
}

}  // namespace corpuscle::coupling
