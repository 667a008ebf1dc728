// Coupling by dual identity (paper, section 2.4): each node of a membrane is both a particle of the fluid and a node of
// the network.
//
// As a particle, the node has the density of the fluid and takes part in pressure, viscosity and continuity; as a node,
// it is subject to the force f of the network, du/dt += f/m. No penetration, no slip and continuity of stress follow.
// Its volume is that of the piece of membrane around it, one spacing thick:  V = A_vertex dx,  m = rho0 V. Interior
// overpressure can push fluid through the single layer of nodes: LeakageGuard moves such particles back.
//
// Rupture is tested at every step, for cells whose laws have a rupture criterion.
#pragma once
#include <functional>
#include <memory>

#include "coupling/densityBalance.hpp"
#include "coupling/leakageGuard.hpp"
#include "coupling/nodeExchange.hpp"
#include "coupling/rupture.hpp"
#include "sph/velocityVerlet.hpp"

namespace corpuscle::coupling {

class DualIdentity : public sph::Load {
  public:
    // Intervals of the leakage guard and of the density balance, in steps; 0: never.
    struct Intervals {
        long guard = 10, densityBalance = 10;
    };
    // Distance from its brick up to which a rank needs the nodes of membranes [m].
    static double margin(double spacing, double skin) { return LeakageGuard::reachInSpacings * spacing + skin; }

    DualIdentity(Cells& cells, double spacing, const DensityBalance& balance, Intervals intervals);

    void moved(particles::ParticleSystem& system, double extrapolation, bool rebuilt) override;
    void addAccelerations(particles::ParticleSystem& system) override;
    void addRates(const particles::ParticleSystem& system, const sph::FluidForces& forces,
                  sph::Budget::Values& rates) const override;

    // Called after each step of length dt [s]: rupture, leakage guard, density balance. Returns the bonds that broke.
    // budget: to which the energy released by rupture is added; null: no budget is kept. Collective.
    std::vector<RuptureEvent> endStep(particles::ParticleSystem& system, double dt, sph::Budget* budget = nullptr);

    LeakageGuard& guard() { return guard_; }
    const LeakageGuard& guard() const { return guard_; }
    const DensityBalance& densityBalance() const { return balance_; }
    long steps() const { return steps_; }
    void restore(long steps) { steps_ = steps; }

    // Squared angular frequency of the stiffest mode of the nodes of any cell: the largest eigenvalue of M^-1 K, by
    // power iterations on differences of elastic forces [1/s^2]. Collective.
    double springRate2(const particles::ParticleSystem& system, int iterations) const;
    // Largest decay rate by the viscosity of any membrane: largest eigenvalue of M^-1 C, f = -C v [1/s]. Collective.
    double membraneRate(const particles::ParticleSystem& system, int iterations) const;

  private:
    Cells& cells_;
    NodeExchange exchange_;
    LeakageGuard guard_;
    DensityBalance balance_;
    Intervals intervals_;
    long steps_ = 0;
};

}  // namespace corpuscle::coupling
