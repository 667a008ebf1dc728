// A field of the fluid less its noise, for pictures: the mean around each particle (meanPair.hpp) over fluid particles
// of its own side.
#pragma once
#include <vector>

#include "particles/particleSystem.hpp"
#include "sph/kernel.hpp"

namespace corpuscle::sph {

// values: of the particles of this rank, whatever the unit; those of other kinds are neither read nor changed. mass: of
// a particle where the store has none of its own [kg]. Membranes part sides (0 outside, n inside cell n). Leaves the
// system as it is. Collective.
std::vector<double> localMean(particles::ParticleSystem& system, const Kernel& kernel, double mass,
                              std::vector<double> values);

}  // namespace corpuscle::sph
