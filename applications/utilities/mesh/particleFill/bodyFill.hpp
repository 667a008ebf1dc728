// Which lattice points become a rigid body's particles: those deepest in it, in it and just outside, as many as make up
// its volume.
#pragma once
#include "geometry/triangleMesh.hpp"
#include "simulation/case.hpp"

namespace corpuscle::utilities {

// Of each point the number of the body that takes it, 1 and up; 0: none. Throws Failure(invalidCase) for a body that
// cannot be filled.
std::vector<int> bodyOfEach(const simulation::Case& input, const std::vector<geometry::TriangleMesh>& bodies,
                            const std::vector<Vec3>& points);

}  // namespace corpuscle::utilities
