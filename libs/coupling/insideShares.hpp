// How much of each particle of fluid lies within a membrane (sph/excessStress.hpp): by its signed distance d from the
// membrane, positive outside,
//
//     f = 1/2 - d/dx,  from 0 to 1
// the share of a cube of side dx that lies behind a plane along its faces. Where no membrane is near, and in an opened
// cell, f is 1 or 0 by the particle's viscosity.
#pragma once
#include <vector>

#include "coupling/noFlux.hpp"
#include "coupling/scene.hpp"
#include "sph/excessStress.hpp"

namespace corpuscle::coupling {

// Of owned particles. noFlux: who is near a membrane where particles and nodes are now; null without cells.
std::vector<sph::Inside> insideShares(const Scene& scene, const NoFlux* noFlux);

}  // namespace corpuscle::coupling
