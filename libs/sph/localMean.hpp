// A field of the fluid with reduced noise, for pictures: the mean around each particle (meanPair.hpp) over the fluid
// particles on its side of membranes.
#pragma once
#include <vector>

#include "particles/particleSystem.hpp"
#include "sph/kernel.hpp"

namespace corpuscle::sph {

// values: of the particles of this rank, in any unit; those of particles that are not fluid do not enter and are not
// changed. mass: of a particle, if the store has no masses [kg]. Sides (0 outside, n inside cell n) are separated by
// membranes. The system is not changed. Collective.
std::vector<double> localMean(particles::ParticleSystem& system, const Kernel& kernel, double mass,
                              std::vector<double> values);

}  // namespace corpuscle::sph
