// Velocity Verlet on operators that are adjoint to each other, with membranes immersed in the fluid
// (coupling/adjointVerlet.hpp): the variant of velocityVerlet where operators are corrected or membranes immersed.
#pragma once
#include "schemes/scheme.hpp"

namespace corpuscle::schemes {

std::shared_ptr<const Scheme> adjointVerlet();

}  // namespace corpuscle::schemes
