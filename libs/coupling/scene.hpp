// Everything that is simulated: particles, fluid, walls, rigid bodies, cells; what observers read and integrators
// advance.
#pragma once
#include <memory>
#include <vector>

#include "bodies/bodies.hpp"
#include "coupling/cellContacts.hpp"
#include "coupling/dualIdentity.hpp"
#include "particles/particleSystem.hpp"
#include "sph/flow.hpp"
#include "sph/fluidForces.hpp"

namespace corpuscle::coupling {

struct Scene {
    std::unique_ptr<particles::ParticleSystem> system;  // its box holds the walls' layers too
    particles::Box fluidBox;                            // the smallest around the fluid
    double fluidVolume = 0;                             // between the walls, with all that floats in it [m^3]
    sph::FlowState flow;
    std::unique_ptr<bodies::Bodies> bodies;    // none unless the case has rigid bodies
    std::unique_ptr<sph::FluidForces> forces;  // with the fluid's model
    std::unique_ptr<sph::Shifting> shifting;   // none unless the case names it
    Cells cells;                               // none for a fluid alone
    std::unique_ptr<CellContacts> contacts;    // none unless the case has contact
    std::unique_ptr<DualIdentity> coupling;    // none without cells
    std::vector<RuptureEvent> broken;          // at the last step, of the cells that this rank holds
    sph::Budget budget;                        // of energy and momentum; not kept unless an observer asks for it
    long movedBack =
        0;  // fluid particles of this rank that had crossed a membrane and were moved back, since the start
    double spacing = 0;  // dx [m]

    const sph::FluidModel& model() const { return forces->model(); }
    particles::ParticleStore& store() { return system->store(); }
    const particles::ParticleStore& store() const { return system->store(); }
    double mass(std::size_t i) const { return store().optional().mass ? store().mass[i] : model().mass; }
};

}  // namespace corpuscle::coupling
