// Two parallel plane walls made of particles: layers beyond the surfaces, moving with prescribed velocity. Their density follows
// the continuity equation, so that they push back where fluid comes close; their velocity enters viscosity through beta
// (fluidPair.hpp), so that the fluid meets the wall's velocity on the surface itself.
#pragma once
#include "core/vec.hpp"

namespace corpuscle::sph {

struct Walls {
    int axis = -1;                                    // 0, 1, 2; -1: none
    double low = 0, high = 0;                         // surfaces [m]
    Vec3 velocity[2] = {Vec3::Zero(), Vec3::Zero()};  // of the lower and the upper wall [m/s]

    bool exist() const { return axis >= 0; }
    bool isUpper(const Vec3& p) const { return p[axis] > 0.5 * (low + high); }
};

}  // namespace corpuscle::sph
