// Density against volume, cell by cell.
//
// The continuity equation is a sum over pairs whose divergence does not vanish exactly on sheared, disordered
// particles: over tens of strains the density of a region wanders away from mass over volume, and the equation of state
// then moves the membrane instead, by some per cent of a cell's volume. But a closed cell's volume is known from its
// mesh, and so is that of the fluid around. Every few steps the densities of each region are multiplied by one factor,
// close to 1,
//
//     factor = [sum_fluid m_i/rho_i + 1/2 sum_nodes m_n/rho_n] / [V(t)/V(0) (sum_fluid m_i + 1/2 sum_nodes m_n)/rho0]
//
// inside each closed cell, and likewise outside all of them, V = fluid box - closed cells, both less the rigid bodies
// in them, where nodes of open cells count whole. A node belongs half to either side and takes the mean of both
// factors; so a few applications bring the sums to what they should be, and a cell that is little more than its nodes
// is not driven harder than others. A region's pressure then follows its volume as the bulk modulus says; differences
// within a region, and momentum, are not touched. Pressure waves are left to the continuity equation.
#pragma once
#include <vector>

#include "coupling/holderSums.hpp"

namespace corpuscle::coupling {

class DensityBalance {
  public:
    // fluidVolume: of the box between the walls, less the rigid bodies outside all cells [m^3]; density: rho0; mass: of
    // a particle where all have the same.
    DensityBalance(double fluidVolume, double density, double mass = 0)
        : fluidVolume_(fluidVolume), density_(density), mass_(mass) {}

    // Collective.
    void apply(particles::ParticleSystem& system, const Cells& cells);

    // Largest |factor - 1| of any application so far, the same on all ranks.
    double largest() const { return largest_; }

  private:
    double fluidVolume_, density_, mass_, largest_ = 0;
    HolderSums sums_;
};

}  // namespace corpuscle::coupling
