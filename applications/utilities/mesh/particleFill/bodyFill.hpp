// Selects the lattice points that become particles of a rigid body, in the order of their signed distance from its
// surface: the deepest inside first, if need be some just outside, until their volume is that of the body.
#pragma once
#include "geometry/triangleMesh.hpp"
#include "simulation/case.hpp"

namespace corpuscle::utilities {

// The number of the body, from 1, that each point belongs to; 0: none. Throws Failure(invalidCase) for a body that
// cannot be filled.
std::vector<int> bodyOfEach(const simulation::Case& input, const std::vector<geometry::TriangleMesh>& bodies,
                            const std::vector<Vec3>& points);

}  // namespace corpuscle::utilities
