// The scene: everything that is simulated (particles, fluid, walls, rigid bodies, cells). Observers read it, schemes
// advance it.
#pragma once
#include <memory>
#include <vector>

#include "bodies/bodies.hpp"
#include "coupling/cellContacts.hpp"
#include "coupling/dualIdentity.hpp"
#include "coupling/flowControl.hpp"
#include "coupling/soluteTransport.hpp"
#include "particles/particleSystem.hpp"
#include "sph/flow.hpp"
#include "sph/fluidForces.hpp"

namespace corpuscle::coupling {

struct Scene {
    std::unique_ptr<particles::ParticleSystem> system;  // its box includes the layers of wall particles
    particles::Box fluidBox;                            // the smallest box around the fluid
    double fluidVolume = 0;                             // between the walls, cells and rigid bodies included [m^3]
    sph::FlowState flow;
    std::unique_ptr<bodies::Bodies> bodies;    // null without rigid bodies
    std::unique_ptr<sph::FluidForces> forces;  // includes the model of the fluid
    std::unique_ptr<sph::Shifting> shifting;   // null unless the case has shifting
    Cells cells;                               // empty for a fluid alone
    std::unique_ptr<CellContacts> contacts;    // null unless the case has contact
    std::unique_ptr<DualIdentity> coupling;    // null without cells
    std::unique_ptr<SoluteTransport> solute;   // null unless the fluid carries a solute
    std::vector<RuptureEvent> broken;          // bonds broken in the last step, of the cells that this rank holds
    sph::Budget budget;                        // of energy and momentum; kept only if an observer asks for it
    // Fluid particles of this rank that had crossed a membrane and were moved back, since the start.
    long movedBack = 0;
    double spacing = 0;                    // dx [m]
    double now = 0;                        // time at which the present step begins [s]
    std::unique_ptr<FlowControl> control;  // null unless the flow has a given flow rate

    // Sets the body force and the velocities of walls to their values at t [s]. Schemes call it with the time at which
    // they take them.
    void driveAt(double t);

    // Moves the solute, if there is one, for dt [s] at the present positions, `rest` before the end of the step; lists
    // must be up to date. Collective.
    void moveSolute(double dt, double rest = 0) {
        if (solute) solute->advance(cells, *system, dt, rest);
    }
    const sph::FluidModel& model() const { return forces->model(); }
    particles::ParticleStore& store() { return system->store(); }
    const particles::ParticleStore& store() const { return system->store(); }
    double mass(std::size_t i) const { return store().optional().mass ? store().mass[i] : model().mass; }
};

}  // namespace corpuscle::coupling
