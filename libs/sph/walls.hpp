// Two parallel plane walls made of particles: layers beyond the surfaces, moving with prescribed velocity. Their
// density follows the continuity equation, so that they push back where fluid comes close; their velocity enters
// viscosity through beta (fluidPair.hpp), so that the fluid meets the wall's velocity on the surface itself.
#pragma once
#include <array>

#include "particles/box.hpp"
#include "sph/wallPlanes.hpp"

namespace corpuscle::sph {

struct Walls {
    int axis = -1;                                             // 0, 1, 2; -1: none
    double low = 0, high = 0;                                  // surfaces [m]
    std::array<Vec3, 2> velocity{Vec3::Zero(), Vec3::Zero()};  // of the lower and the upper wall [m/s]

    bool exist() const { return axis >= 0; }
    bool isUpper(const Vec3& p) const { return p[axis] > 0.5 * (low + high); }
};

// As the records of pair laws see them (pairLoop.hpp): lengths in supports H, from the middle of the box. A fluid
// particle that has come very close to a wall counts as a quarter of a spacing away, and beta is at most ten.
inline WallPlanes planes(const Walls& walls, const particles::Box& box, double spacing, double H) {
    WallPlanes p;
    p.normal[walls.axis] = 1;
    p.middle = (0.5 * (walls.low + walls.high) - box.middle()[walls.axis]) / H;
    p.half = 0.5 * (walls.high - walls.low) / H;
    p.smallestDistance = 0.25 * spacing / H;
    p.betaMax = 10;
    return p;
}

}  // namespace corpuscle::sph
