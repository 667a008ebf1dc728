// Share of each fluid particle that lies within a membrane (sph/excessStress.hpp): with its signed distance d from the
// membrane, positive outside, and the sum k of the principal curvatures of the membrane near it,
//
//     f = 1/2 - d/dx - k dx/24,  limited to 0 to 1
//     k = sum_m W_m G_m.n_m/sum_m W_m |A_m|,    the mean of the curvatures G_m.n_m/|A_m| of the nodes
// symbol   | meaning
// A_m, n_m | derivative of the enclosed volume with respect to the position of node m; its direction
// G_m      | derivative of the area of the membrane with respect to the position of node m
// W_m      | a smooth function of the distance of the particle from the node, 0 at 2 dx (nodeBasis.hpp)
// The curvature at the nearest point would not be continuous in the particle's position where the membrane is folded.
//
// Without k, f is the share of a cube of side dx that lies behind a plane parallel to its faces. For a curved surface
// that is too large: the sum of the shares would exceed the enclosed volume by dx^2/24 int k dA, which for a sphere of
// radius a, in dx, is 1/(4 a^2) of its volume. Where no membrane is near, and in an opened cell, f is 1 or 0 according
// to the viscosity of the particle.
#pragma once
#include <vector>

#include "coupling/noFlux.hpp"
#include "coupling/scene.hpp"
#include "sph/excessStress.hpp"

namespace corpuscle::coupling {

// Shares of the owned particles. noFlux, immersed: of the particles and nodes at the present positions; null without
// cells.
std::vector<sph::Inside> insideShares(const Scene& scene, const NoFlux* noFlux, const Immersed* immersed);

}  // namespace corpuscle::coupling
