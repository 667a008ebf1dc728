// Immersed coupling: fluid particles fill space without regard to the membrane, and a node has no mass of its own. It
// moves with the velocity interpolated from the fluid around it, and its force is spread to that fluid with the same
// weights:
//
//     u_m = P S u,     f_fluid = S^T P f_m
// symbol | meaning
// S      | interpolation from the fluid to the nodes (nodeFluidMap.hpp)
// P      | projection that conserves the volume of closed cells (volumeProjection.hpp). For a torn cell, P S is
//        | P S - g H/(g.g), and S^T P its transpose, with the flux H u of the fluid through its holes (holeFlux.hpp)
// K, C   | stiffness and damping of the membranes (membraneStiffness.hpp); K with that of contact (cellContacts.hpp)
// The two maps are transposes of each other, so the exchange conserves power. The stiffness that acts on the fluid is
// S^T P K P S, symmetric and positive semi-definite as K is.
//
// A rank has the nodes of the cells that it holds, bitwise identical to those on the other holders, and the weights of
// its own particles. Forces on ghosts (particles/sharedParticles.hpp) need the weights of ghosts as well:
// `placeOthers`.
#pragma once
#include "coupling/cellContacts.hpp"
#include "coupling/holeFlux.hpp"
#include "coupling/membraneStiffness.hpp"
#include "coupling/nodeFluidMap.hpp"
#include "coupling/volumeProjection.hpp"
#include "sph/fluidForces.hpp"

namespace corpuscle::coupling {

class Immersed {
  public:
    using Vectors = NodeVectors;
    static constexpr double radiusInSpacings = NodeFluidMap::radiusInSpacings;

    // Distance from its brick up to which a rank needs the nodes of membranes, for its own particles and for the ghosts
    // that it has [m].
    static double margin(double spacing, double support, double skin) {
        return radiusInSpacings * spacing + support + 2 * skin;
    }

    // model: of the fluid. contacts: null without contact. Arguments are kept by reference and must not move in memory.
    Immersed(Cells& cells, const sph::FluidModel& model, const particles::ParticleSystem& system,
             CellContacts* contacts = nullptr);

    Cells& cells() { return cells_; }
    const Cells& cells() const { return cells_; }
    const NodeLayout& layout() const { return layout_; }
    void move(double seconds);  // moves nodes along their velocities
    // Moves nodes from the beginning of a step to the positions x* where its forces are evaluated; takeBack moves them
    // back. onArc: to the middle of the arc on which each cell rotates (arc.hpp).
    void depart(double seconds, bool onArc);
    void takeBack(double seconds);
    // Fraction of the motion of the last `depart` that was free of contact, over all ranks. Collective.
    double freeDeparture() const;
    // The same for the motion from x*, `seconds` after the beginning of a step of dt, to its end and `more` seconds
    // beyond, with these velocities over the whole step. Collective.
    double freeArrival(double seconds, double dt, const Vectors& velocities, double more) const;
    // If images of the box slide: replaces each cell whose centre has left the box across the sliding faces by its
    // image inside.
    void wrapCells();
    Vectors velocities() const;
    void setVelocities(const Vectors& velocities);
    void restoreVolume() { VolumeProjection::restore(cells_); }

    // Determines the holders of cells, the weights of particles and the forces of membranes at the present positions.
    // volume: of each particle [m^3]. Collective. Throws Failure(numerics), on all ranks, if a node has no fluid around
    // it.
    void place(const particles::ParticleSystem& system, const std::vector<double>& volume);
    // `place`, and the stiffness and damping of the membranes.
    void build(const particles::ParticleSystem& system, const std::vector<double>& volume);

    // Weights of ghosts, to be called right after `place`. Collective.
    void placeOthers(particles::ParticleSystem& system, const particles::SharedParticles& shared,
                     const std::vector<double>& volume);

    // P S u for changes of velocity u, of four numbers per particle. Collective.
    template <class Real>
    Vectors interpolate(const Real* u) {
        Vectors v = map_.interpolate(u);
        if (holes_.exist())
            volume_.apply(v, holes_.of(u));
        else
            volume_.apply(v);
        return v;
    }
    // The same for velocities: images of particles that slide have their slide velocity in addition.
    template <class Real>
    Vectors interpolateVelocities(const Real* u) {
        Vectors v = map_.interpolate(u);
        map_.addSlides(v);
        if (!holes_.exist()) {
            volume_.apply(v);
            return v;
        }
        std::vector<double> flux = holes_.of(u);
        holes_.addSlides(flux);
        volume_.apply(v, flux);
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
    // A third of the trace of (time K + C) per node [N s/m], without contact. Collective.
    double meanResistance(double time) const { return stiffness_.meanResistance(time, comm_); }
    bool isViscous() const;
    void addViscousForces(const Vectors& u, Vectors& f) const {  // f -= C u; needs no `build`
        MembraneStiffness::addViscousForces(cells_, layout_, u, f);
    }
    Vectors forceAt(const Vectors& displacement) const {  // elastic and contact forces with nodes displaced [N]
        Vectors f = MembraneStiffness::forceAt(cells_, layout_, displacement);
        if (contacts_) contacts_->addForcesAt(displacement, f);
        return f;
    }
    // force_j += (S^T P f)_j, of four numbers per particle.
    void spread(Vectors f, particles::RealArray& force) const;
    // The same on ghosts, into their entries of `force`; after placeOthers.
    void spreadToOthers(Vectors f, particles::RealArray& force) const;

    // a.b over the nodes of the cells that this rank owns: its part of the sum over all nodes of the scene.
    double ownDot(const Vectors& a, const Vectors& b) const {
        return layout_.sumOverOwned(cells_, rank_, [&](std::size_t m) { return a[m].dot(b[m]); });
    }

    const CellContacts* contacts() const { return contacts_; }

    // Own particles to which `spread` adds, and entries of ghosts to which `spreadToOthers` adds.
    const std::vector<int>& touched() const { return holes_.exist() ? touched_ : map_.touched(); }
    const std::vector<int>& touchedOthers() const { return holes_.exist() ? touchedOthers_ : map_.touchedOthers(); }
    // Own particles with weights for a node of one held cell.
    const std::vector<int>& touchedBy(std::size_t cell) const { return map_.touchedBy(cell); }

    // f(node, particle, weight) for the nodes of one held cell, counted from its first, and the own particles within
    // two spacings of them; the weights fall to 0 there.
    template <class F>
    void forNear(std::size_t cell, F&& f) const {
        const std::size_t first = layout_.first(cell);
        map_.forNear(first, layout_.last(cell),
                     [&](std::size_t m, int particle, double weight) { f(m - first, particle, weight); });
    }

    // Number of nodes with a share of the plain mean (nodeFluidMap.hpp), over all ranks, at the last `place`; and the
    // largest of any `place`.
    long fallbacks() const { return map_.fallbacks(); }
    long mostFallbacks() const { return map_.mostFallbacks(); }

  private:
    void addContact();

    Cells& cells_;
    const particles::ParticleSystem& system_;
    CellContacts* contacts_;
    Vectors departure_;    // positions before the last `depart`; with contact only
    double departed_ = 0;  // duration of the last `depart` [s]
    double outlook_ = 0;   // time ahead for which the lists of contact are made [s]
    NodeFluidMap map_;
    NodeLayout layout_;
    VolumeProjection volume_;
    HoleFlux holes_;
    std::vector<int> touched_, touchedOthers_;  // with a torn cell only
    MembraneStiffness stiffness_;
    MPI_Comm comm_ = MPI_COMM_NULL;
    int rank_ = 0;
};

}  // namespace corpuscle::coupling
