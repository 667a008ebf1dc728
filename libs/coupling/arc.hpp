// From the chord to the arc: nodes of a cell that turns, halfway through a step.
//
// A point that turns with angular velocity w about c is, halfway through a step of length dt, not in the middle of the
// chord between its two ends but beyond it, by -dt^2/8 of its acceleration to second order in dt:
//
//     x* = x + s u + shift,   shift = -s^2/2 w x (w x (x + s u - c)),   s = dt/2
// symbol | meaning                                                                                   | unit
// x, u   | place of a node at the beginning of the step, its velocity                                | m, m/s
// c, w   | mean place of the cell's nodes at x + s u; rotation nearest to their velocities by        | m, 1/s
//        | least squares, w = I^-1 sum r x (u - mean u), I = sum (r^2 - r r^T), r = x + s u - c       |
//
// Why. A membrane that resists stretching has its size where its forces are taken, at x*. On the chord it would then be
// larger by 1 + (w dt)^2/8 at both ends of the step, and as that surplus belongs to dt, a step of another length would
// have to change it: with strain rates of about w^2 dt/4 that change sign from step to step, and which the error
// control takes for motion.
//
// Of the acceleration only the rotation of the whole cell is in it: that is smooth in time, whereas differences of
// nodes' velocities carry what is left of stiff modes. The shift multiplies distances from the axis through c along w
// by 1 + (w s)^2/2, so that it can be taken back without a record of the nodes.
#pragma once
#include <vector>

#include "core/vec.hpp"

namespace corpuscle::coupling {

struct Arc {
    Vec3 centre = Vec3::Zero();  // c [m]
    Vec3 turn = Vec3::Zero();    // s w; zero: no shift

    // Of nodes in the middle of the chord. `seconds`: s.
    static Arc of(const std::vector<Vec3>& position, const std::vector<Vec3>& velocity, double seconds);

    Vec3 fromChord(const Vec3& x) const { return x + 0.5 * turn.squaredNorm() * fromAxis(x); }
    Vec3 toChord(const Vec3& x) const {
        const double share = 0.5 * turn.squaredNorm();
        return x - share / (1 + share) * fromAxis(x);
    }

  private:
    Vec3 fromAxis(const Vec3& x) const {  // shortest way from the axis to x; zero where nothing turns
        const double square = turn.squaredNorm();
        return square > 0 ? Vec3(x - centre - (x - centre).dot(turn) / square * turn) : Vec3(Vec3::Zero());
    }
};

}  // namespace corpuscle::coupling
