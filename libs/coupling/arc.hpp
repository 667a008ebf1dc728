// Position of the nodes of a rotating cell halfway through a step: on the arc of the rotation, not on its chord.
//
// A point that rotates with angular velocity w about c moves on an arc. Halfway through a step of length dt it is not
// at the middle of the chord from start to end but outside it: to second order in dt, by -dt^2/8 times its
// acceleration,
//
//     x* = x + s u + shift,   shift = -s^2/2 w x (w x (x + s u - c)),   s = dt/2
// symbol | meaning                                                                                   | unit
// x, u   | position of a node at the beginning of the step, its velocity                             | m, m/s
// c, w   | mean position of the cell's nodes at x + s u; rotation that fits their velocities by      | m, 1/s
//        | least squares, w = I^-1 sum r x (u - mean u), I = sum (r^2 - r r^T), r = x + s u - c       |
//
// Why the arc: forces are evaluated at x*, so a membrane that resists stretching takes its equilibrium size there. With
// x* on the chord it would be larger by the factor 1 + (w dt)^2/8 at both ends of the step. Since this excess depends
// on dt, each change of the step length would change it, with strain rates of about w^2 dt/4 that alternate in sign
// from step to step, which the error control would mistake for motion.
//
// The shift includes only the acceleration due to the rotation of the whole cell, which is smooth in time; differences
// of the nodes' velocities would also contain residues of stiff modes. The shift multiplies distances from the axis
// through c along w by 1 + (w s)^2/2, so it can be undone without stored node positions.
#pragma once
#include <vector>

#include "core/vec.hpp"

namespace corpuscle::coupling {

struct Arc {
    Vec3 centre = Vec3::Zero();  // c [m]
    Vec3 turn = Vec3::Zero();    // s w: rotation during half a step; zero: no shift

    // Arc of a cell with these node positions x + s u, at the middle of the chord, and velocities u. seconds: s.
    static Arc of(const std::vector<Vec3>& position, const std::vector<Vec3>& velocity, double seconds);

    Vec3 fromChord(const Vec3& x) const { return x + 0.5 * turn.squaredNorm() * fromAxis(x); }
    Vec3 toChord(const Vec3& x) const {
        const double share = 0.5 * turn.squaredNorm();
        return x - share / (1 + share) * fromAxis(x);
    }

  private:
    Vec3 fromAxis(const Vec3& x) const {  // perpendicular vector from the axis to x; zero without rotation
        const double square = turn.squaredNorm();
        return square > 0 ? Vec3(x - centre - (x - centre).dot(turn) / square * turn) : Vec3(Vec3::Zero());
    }
};

}  // namespace corpuscle::coupling
