// One membrane: the network of a cell with the laws that its case names, and the state of its nodes.
//
// Positions are unwrapped (contiguous across periodic faces). Each rank that holds a cell holds the whole cell,
// computes the same forces in the same order (bitwise identical, so that rupture needs no messages) and keeps the
// forces on its own nodes.
//
// Membranes of one type share the type's network and the terms of its laws as long as they are whole. A membrane that
// breaks gets its own.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "membrane/membraneSettings.hpp"
#include "membrane/network.hpp"
#include "membrane/term.hpp"

namespace corpuscle::membrane {

// What membranes of one type have in common: a mesh, its stress-free shape, and laws.
class MembraneType {
  public:
    // `radius` is the length a in Eb = kappa/(Gs a^2).
    MembraneType(std::vector<Vec3> stressFree, std::vector<Index3> triangles, const MembraneSettings& settings,
                 double radius);
    MembraneType(const MembraneType&) = delete;
    MembraneType& operator=(const MembraneType&) = delete;

    const Network& network() const { return network_; }
    const MembraneSettings& laws() const { return laws_; }
    const MembraneScale& scale() const { return scale_; }
    const std::vector<std::unique_ptr<Term>>& terms() const { return terms_; }

  private:
    friend class Membrane;
    Network network_;  // terms refer to it
    MembraneSettings laws_;
    MembraneScale scale_;
    std::vector<std::unique_ptr<Term>> terms_;
};

class Membrane {
  public:
    // Initial velocities are zero.
    Membrane(std::string name, int cell, std::vector<Vec3> nodes, std::shared_ptr<MembraneType> type);
    // A membrane with a type of its own. `stressFree`: node positions in the stress-free shape; empty: `nodes`.
    Membrane(std::string name, int cell, const std::vector<Vec3>& nodes, std::vector<Index3> triangles,
             const MembraneSettings& settings, double radius, std::vector<Vec3> stressFree = {});

    std::string name;
    int cell;  // number of the cell, from 1; also the `side` of the fluid particles inside it
    std::vector<Vec3> position, velocity, force;  // m, m/s, N

    const Network& network() const { return type_->network(); }
    const std::vector<Vec3>& initialPosition() const { return initialPosition_; }
    const MembraneSettings& laws() const { return type_->laws(); }
    const MembraneScale& scale() const { return type_->scale(); }

    void computeForces();  // force = -d(energy)/d(position) of all terms, plus viscous forces
    void addElasticForces(std::span<const Vec3> x, std::span<Vec3> f) const;
    bool isViscous() const { return laws().viscosity.has_value(); }
    // Viscous forces for velocities v at the present positions. They are linear in v, since the viscosity is taken at
    // the membrane's own velocity.
    void addViscousForces(std::span<const Vec3> v, std::span<Vec3> f) const;
    double energy() const;  // J
    void addStiffness(Definiteness definiteness, Stiffness& stiffness) const;
    // Adds the matrix C of the viscous forces -C v, N s/m; nothing if the membrane is not viscous.
    void addDamping(Stiffness& damping) const;
    double maxStiffness() const;  // upper bound of the largest eigenvalue of the present stiffness, N/m

    bool canRupture() const { return static_cast<bool>(laws().rupture); }
    // Brings the damage, and what it takes from the energy, up to the present positions, dt [s] after the last
    // evaluation; bonds that hold again are living ones then. Returns the bonds that break now, by the rupture law;
    // breakBonds breaks them.
    std::vector<BrokenBond> findBroken(double dt);
    // Breaks these bonds, then those that by their loss break at the same positions, until nothing more breaks; returns
    // all of them.
    std::vector<BrokenBond> breakBonds(std::vector<BrokenBond> broken);
    // Excess of the rupture law (ruptureLaw.hpp) with nodes at x, dt [s] after its last evaluation: the greatest of any
    // element after `rank` greater ones; -1 where there is none.
    double ruptureExcess(std::span<const Vec3> x, double dt, std::size_t rank = 0) const;
    double ruptureTolerance() const { return canRupture() ? laws().rupture->tolerance() : 0; }
    // Whether the energy changes while no bond breaks, because the rupture law weakens the sheet.
    bool canWeaken() const { return static_cast<bool>(whole_); }
    // Damage of each triangle or each node, as the rupture law keeps it, 0 to 1; empty if it keeps none. A broken
    // triangle keeps the damage it had as it broke.
    const std::vector<double>& damage() const { return damage_; }
    double maxDamage() const;   // of the whole triangles or their nodes; 0 if none is kept
    double tearLength() const;  // by the rupture law (ruptureLaw.hpp), m
    // Share of the present area at each node that is pores (poreLaw.hpp); empty without a pore law.
    const std::vector<double>& pores() const { return pores_; }
    void openPores(double dt);  // brings them up to the present positions, dt [s] after the last call
    double poreArea() const;    // m^2
    // State of a checkpoint. Throws Failure(ExitCode::io) when it is of another mesh or law. No pores: they begin
    // closed.
    void restore(std::vector<char> aliveBonds, std::vector<double> damage = {}, std::vector<double> pores = {});

    double area() const;  // of the whole triangles, m^2
    // Enclosed volume, m^3, where a fan of triangles over its rim closes each hole. Meaningless for a mesh that was
    // made with a border.
    double volume() const;
    std::vector<double> vertexAreas() const;  // for each node, a third of each of its whole triangles, m^2

  private:
    Network& ownNetwork();  // makes a type of its own if the type is shared
    RuptureStep ruptureStep(std::span<const Vec3> x, double dt) const;
    void weaken();  // gives the network the shares of the damage
    std::vector<Vec3> initialPosition_;
    std::shared_ptr<MembraneType> type_;
    std::shared_ptr<const MembraneType> whole_;  // as it was made, if the rupture law weakens the sheet; otherwise none
    std::vector<double> damage_, pores_;
};

}  // namespace corpuscle::membrane
