// Coupling by dual identity (paper, section 2.4): a membrane's node is a particle of the fluid and a node of its
// network.
//
// As a particle it has the density of the fluid and takes part in pressure, viscosity and continuity; as a node it
// feels the network, du/dt += f/m. No penetration, no slip and continuity of stress follow. Its volume is that of the
// piece of membrane around it, one spacing thick:  V = A_vertex dx,  m = rho0 V. Interior overpressure can push fluid
// through the single layer of nodes: LeakageGuard puts such particles back.
//
// Rupture is tested at every step, only where a cell's case names a criterion.
#pragma once
#include <functional>
#include <memory>

#include "coupling/densityBalance.hpp"
#include "coupling/leakageGuard.hpp"
#include "coupling/nodeExchange.hpp"
#include "sph/velocityVerlet.hpp"

namespace corpuscle::coupling {

// Bonds of one cell that broke at one step.
struct RuptureEvent {
    int cell;  // number, 1 and up
    std::vector<membrane::BrokenBond> bonds;
};

class DualIdentity : public sph::Load {
  public:
    // How often the guard looks and densities are balanced, in steps; 0: never.
    struct Intervals {
        long guard = 10, densityBalance = 10;
    };
    // How far from its brick a rank must know the nodes of membranes [m].
    static double margin(double spacing, double skin) { return LeakageGuard::reachInSpacings * spacing + skin; }

    DualIdentity(Cells& cells, double spacing, const DensityBalance& balance, Intervals intervals);

    void moved(particles::ParticleSystem& system, double extrapolation, bool rebuilt) override;
    void addAccelerations(particles::ParticleSystem& system) override;
    void addRates(const particles::ParticleSystem& system, const sph::FluidForces& forces,
                  sph::Budget::Values& rates) const override;

    // After each step, of dt [s]: rupture, guard, density balance. Returns what broke. budget: null, or what is to be
    // kept. Collective.
    std::vector<RuptureEvent> endStep(particles::ParticleSystem& system, double dt, sph::Budget* budget = nullptr);

    LeakageGuard& guard() { return guard_; }
    const LeakageGuard& guard() const { return guard_; }
    const DensityBalance& densityBalance() const { return balance_; }
    long steps() const { return steps_; }
    void restore(long steps) { steps_ = steps; }

    // Squared frequency of the stiffest mode of any cell's nodes on their springs: the largest eigenvalue of M^-1 K, by
    // power iterations on differences of forces [1/s^2]. Collective.
    double springRate2(const particles::ParticleSystem& system, int iterations) const;
    // Fastest decay by the viscosity of any membrane: the largest eigenvalue of M^-1 C, f = -C v [1/s]. Collective.
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
