// One membrane: the network of a cell with the laws that its case names, and the state of its nodes.
//
// Positions are unwrapped (contiguous across periodic faces). Each rank that the cell touches holds it whole,
// computes the same forces in the same order (same bits, so rupture needs no messages) and keeps those of its own
// nodes.
//
// Membranes of one type share its network and the terms of its laws for as long as they are whole. One that breaks gets
// its own.
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
    // Nodes start at rest.
    Membrane(std::string name, int cell, std::vector<Vec3> nodes, std::shared_ptr<MembraneType> type);
    // Of a type of its own. `stressFree`: places of the nodes in the shape without tension, the same ones when empty.
    Membrane(std::string name, int cell, const std::vector<Vec3>& nodes, std::vector<Index3> triangles,
             const MembraneSettings& settings, double radius, std::vector<Vec3> stressFree = {});

    std::string name;
    int cell;  // number of the cell, 1 and up; `side` of the fluid particles inside it
    std::vector<Vec3> position, velocity, force;  // m, m/s, N

    const Network& network() const { return type_->network(); }
    const std::vector<Vec3>& initialPosition() const { return initialPosition_; }
    const MembraneSettings& laws() const { return type_->laws(); }
    const MembraneScale& scale() const { return type_->scale(); }

    void computeForces();  // force = -d energy/d position, all terms, and those of viscosity
    void addElasticForces(std::span<const Vec3> x, std::span<Vec3> f) const;
    bool isViscous() const { return laws().viscosity.has_value(); }
    // For velocities v at the present positions, by the viscosity that the membrane has at its own velocity: linear in
    // v.
    void addViscousForces(std::span<const Vec3> v, std::span<Vec3> f) const;
    double energy() const;  // J
    void addStiffness(Definiteness definiteness, Stiffness& stiffness) const;
    // The matrix C of these forces -C v, N s/m; nothing when the membrane is not viscous.
    void addDamping(Stiffness& damping) const;
    double maxStiffness() const;  // bound of the stiffness' largest eigenvalue now, N/m

    bool canRupture() const { return static_cast<bool>(laws().rupture); }
    // What the criterion names at the present positions, dt [s] after it was asked last; breakBonds then breaks it.
    std::vector<BrokenBond> findBroken(double dt);
    void breakBonds(const std::vector<BrokenBond>& broken);
    // Of each triangle, 0 to 1, that of a broken one as it broke; empty unless the rupture law keeps it.
    const std::vector<double>& damage() const { return damage_; }
    // State of a checkpoint. Throws Failure(ExitCode::io) when it is of another mesh or law.
    void restore(std::vector<char> aliveBonds, std::vector<double> damage = {});

    double area() const;  // of the whole triangles, m^2
    // Enclosed, m^3. A hole counts as closed by a fan over its rim. No meaning for a mesh that was made with a border.
    double volume() const;
    std::vector<double> vertexAreas() const;  // a third of each whole triangle of a node, m^2

  private:
    Network& ownNetwork();  // the type is no longer shared
    std::vector<Vec3> initialPosition_;
    std::shared_ptr<MembraneType> type_;
    std::vector<double> damage_;
};

}  // namespace corpuscle::membrane
