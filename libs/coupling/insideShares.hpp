// How much of each particle of fluid lies within a membrane (sph/excessStress.hpp): by its signed distance d from the
// membrane, positive outside, and the sum k of the membrane's principal curvatures at the nearest point,
//
//     f = 1/2 - d/dx - k dx/24,  from 0 to 1
// Without k it is the share of a cube of side dx that lies behind a plane along its faces. Of a curved surface that
// is too much: the sum of the shares would exceed what the membrane encloses by dx^2/24 int k dA, 1/(4 a^2) of the
// volume for a sphere of a dx. Where no membrane is near, and in an opened cell, f is 1 or 0 by the particle's
// viscosity.
#pragma once
#include <vector>

#include "coupling/noFlux.hpp"
#include "coupling/scene.hpp"
#include "sph/excessStress.hpp"

namespace corpuscle::coupling {

// Of owned particles. noFlux: who is near a membrane where particles and nodes are now; null without cells.
std::vector<sph::Inside> insideShares(const Scene& scene, const NoFlux* noFlux);

}  // namespace corpuscle::coupling
