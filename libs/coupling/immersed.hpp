// Immersed coupling: fluid fills space through the membrane; a node has no fluid of its own. It moves with the velocity
// that it finds in the fluid around it, and its force goes to that fluid with the same weights:
//
//     u_m = P S u,     f_fluid = S^T P f_m
// symbol | meaning
// S      | from the fluid to the nodes (nodeFluidMap.hpp)
// P      | the volume of closed cells kept (volumeProjection.hpp); it ends when a cell opens
// K, C   | stiffness and damping of the membranes (membraneStiffness.hpp); K with that of contact (cellContacts.hpp)
// Power is neither made nor lost. The stiffness that the fluid feels is S^T P K P S, symmetric and positive
// semi-definite as K is.
//
// A rank knows the nodes of the cells that it holds, the same bits as their other holders, and the weights of its own
// particles. Whoever needs forces on ghosts (particles/sharedParticles.hpp) asks for their weights as well.
#pragma once
#include "coupling/cellContacts.hpp"
#include "coupling/membraneStiffness.hpp"
#include "coupling/nodeFluidMap.hpp"
#include "coupling/volumeProjection.hpp"
#include "sph/fluidForces.hpp"

namespace corpuscle::coupling {

class Immersed {
  public:
    using Vectors = NodeVectors;
    static constexpr double radiusInSpacings = NodeFluidMap::radiusInSpacings;

    // How far from its brick a rank must know the nodes of membranes, for its own particles and those of others that it
    // knows [m].
    static double margin(double spacing, double support, double skin) {
        return radiusInSpacings * spacing + support + 2 * skin;
    }

    // model: of the fluid around them. contacts: null where membranes do not feel each other. All must stay where they
    // are.
    Immersed(Cells& cells, const sph::FluidModel& model, const particles::ParticleSystem& system,
             CellContacts* contacts = nullptr);

    Cells& cells() { return cells_; }
    const Cells& cells() const { return cells_; }
    const NodeLayout& layout() const { return layout_; }
    void move(double seconds);  // nodes along their velocities
    // The same from the beginning of a step to where its forces are taken, and back from there. onArc: that is the
    // middle of the arc on which each cell turns (arc.hpp).
    void depart(double seconds, bool onArc);
    void takeBack(double seconds);
    // Which part of the way of the last `depart` was free of contact; of all ranks. Collective.
    double freeDeparture() const;
    // The same of the way to the end of a step of dt with these velocities, and for `more` seconds on, from where
    // forces are taken, `seconds` after its beginning. Collective.
    double freeArrival(double seconds, double dt, const Vectors& velocities, double more) const;
    // In a box whose images slide, cells whose centre has left it across the sliding faces: their image inside.
    void wrapCells();
    Vectors velocities() const;
    void setVelocities(const Vectors& velocities);
    void restoreVolume() { VolumeProjection::restore(cells_); }

    // Who holds which cell, weights of the particles and forces of the membranes, where particles and nodes are now.
    // volume: of each particle [m^3]. Collective. Throws Failure(numerics), on all ranks, where a node has no fluid
    // around it.
    void place(const particles::ParticleSystem& system, const std::vector<double>& volume);
    // The same with the stiffness of the membranes.
    void build(const particles::ParticleSystem& system, const std::vector<double>& volume);

    // Weights of ghosts too, where `place` has just been. Collective.
    void placeOthers(particles::ParticleSystem& system, const particles::SharedParticles& shared,
                     const std::vector<double>& volume) {
        map_.placeOthers(cells_, layout_, system, shared, volume);
    }

    // P S u, u of four numbers a particle: changes of velocities. Collective.
    template <class Real>
    Vectors interpolate(const Real* u) {
        Vectors v = map_.interpolate(u);
        volume_.apply(v);
        return v;
    }
    // The same of velocities, which images of particles have with their slide.
    template <class Real>
    Vectors interpolateVelocities(const Real* u) {
        Vectors v = map_.interpolate(u);
        map_.addSlides(v);
        volume_.apply(v);
        return v;
    }
    Vectors force() const;                                                  // of the membranes [N]
    void addStiffness(double factor, const Vectors& u, Vectors& f) const {  // collective among holders, with contact
        stiffness_.addStiffness(factor, u, f);
        if (contacts_) contacts_->addStiffness(factor, u, f);
    }
    void addDamping(const Vectors& u, Vectors& f) const { stiffness_.addDamping(u, f); }
    void addResistance(double time, const Vectors& u, Vectors& f) const {  // f -= (time K + C) u
        addStiffness(-time, u, f);
        addDamping(u, f);
    }
    // A third of the trace of (time K + C), per node [N s/m]. Collective.
    double meanResistance(double time) const { return stiffness_.meanResistance(time, comm_); }
    bool isViscous() const;
    void addViscousForces(const Vectors& u, Vectors& f) const {  // f -= C u, without build
        MembraneStiffness::addViscousForces(cells_, layout_, u, f);
    }
    Vectors forceAt(const Vectors& displacement) const {  // of the membranes' elasticity, nodes displaced [N]
        Vectors f = MembraneStiffness::forceAt(cells_, layout_, displacement);
        if (contacts_) contacts_->addForcesAt(displacement, f);
        return f;
    }
    // force_j += (S^T P f)_j, of four numbers a particle.
    void spread(Vectors f, particles::RealArray& force) const;
    // The same on ghosts, in their entries of `force`, after placeOthers.
    void spreadToOthers(Vectors f, particles::RealArray& force) const;

    // a.b over all nodes of the scene, of which this is the rank's part.
    double ownDot(const Vectors& a, const Vectors& b) const {
        return layout_.sumOverOwned(cells_, rank_, [&](std::size_t m) { return a[m].dot(b[m]); });
    }

    const CellContacts* contacts() const { return contacts_; }

    const std::vector<int>& touched() const { return map_.touched(); }  // particles of this rank with weights
    const std::vector<int>& touchedBy(std::size_t cell) const { return map_.touchedBy(cell); }  // of one held cell
    const std::vector<int>& touchedOthers() const { return map_.touchedOthers(); }              // entries of ghosts

    long fallbacks() const { return map_.fallbacks(); }  // nodes of the last build with Shepard's weights, of all ranks
    long mostFallbacks() const { return map_.mostFallbacks(); }  // of any build

  private:
    void addContact();

    Cells& cells_;
    const particles::ParticleSystem& system_;
    CellContacts* contacts_;
    Vectors departure_;    // places before the last `depart`; with contact only
    double departed_ = 0;  // how long that took [s]
    double outlook_ = 0;   // how far ahead the lists of contact look [s]
    NodeFluidMap map_;
    NodeLayout layout_;
    VolumeProjection volume_;
    MembraneStiffness stiffness_;
    MPI_Comm comm_ = MPI_COMM_NULL;
    int rank_ = 0;
};

}  // namespace corpuscle::coupling
