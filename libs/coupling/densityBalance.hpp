// Density balance: keeps the mean density of each region (each cell, and the outside) at its mass over its volume.
//
// The divergence in the continuity equation is a sum over pairs that does not vanish exactly on sheared, disordered
// particles: over tens of strains the density of a region drifts away from mass over volume, and the equation of state
// then moves the membrane instead, by some per cent of a cell's volume. But the volume of a closed cell is known from
// its mesh, and so is that of the fluid around it. Every few steps the densities of each region are multiplied by one
// factor, close to 1,
//
//     factor = [sum_fluid m_i/rho_i + 1/2 sum_nodes m_n/rho_n] / [V(t)/V(0) (sum_fluid m_i + 1/2 sum_nodes m_n)/rho0]
//
// inside each closed cell. The same factor is used outside all closed cells, with V = fluid box - closed cells; there
// nodes of open cells count whole. Rigid bodies are subtracted from the volumes of both. A node belongs half to either
// side and is multiplied by the mean of the two factors; so the sums converge in a few applications, and a cell that
// consists mostly of nodes is not corrected more strongly than others. The pressure of a region then follows its volume
// by the bulk modulus; differences within a region, and momentum, are not changed. Pressure waves are left to the
// continuity equation.
#pragma once
#include <vector>

#include "coupling/holderSums.hpp"

namespace corpuscle::coupling {

class DensityBalance {
  public:
    // fluidVolume: of the box between the walls, less the rigid bodies outside all cells [m^3]; density: rho0 [kg/m^3];
    // mass: of a particle, used if all have the same [kg].
    DensityBalance(double fluidVolume, double density, double mass = 0)
        : fluidVolume_(fluidVolume), density_(density), mass_(mass) {}

    // Multiplies the densities by their factors. Collective.
    void apply(particles::ParticleSystem& system, const Cells& cells);

    // Largest |factor - 1| in any application so far, the same on all ranks.
    double largest() const { return largest_; }

  private:
    double fluidVolume_, density_, mass_, largest_ = 0;
    HolderSums sums_;
};

}  // namespace corpuscle::coupling
