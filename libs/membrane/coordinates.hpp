// Internal coordinates of a membrane: scalars of a few node positions, with their gradients. A law of one scalar
// (harmonic, ...) takes its force from them: F_n = -E'(q) dq/dx_n.
//
// coordinate    | nodes                                      | value
// BondLength    | a, b                                       | l = |x_b - x_a| [m]
// CornerAngle   | apex o, left u, right v                    | angle between u - o and v - o, 0 .. pi [rad]
// DihedralAngle | edge a, b; c left of a->b, d right of it   | angle between the normals of (a,b,c) and (b,a,d),
//               | (seen from outside)                        | -pi .. pi, positive where convex [rad]
//
// Angles come from atan2(|sin|, cos), so their gradients hold their accuracy near 0 and pi (no division by sin).
// Where an angle's plane is undefined (corner angle exactly 0 or pi, triangle of no area) the gradient is zero.
#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "core/vec.hpp"

namespace corpuscle::membrane {

template <int N>
struct Coordinate {
    double value;
    std::array<Vec3, N> gradient;
};

struct BondLength {
    static constexpr int nodes = 2;
    static Coordinate<2> at(const std::array<Vec3, 2>& x) {
        const Vec3 r = x[1] - x[0];
        const double l = r.norm();
        const Vec3 e = l > 0 ? Vec3(r / l) : Vec3(Vec3::Zero());
        return {l, {-e, e}};
    }
};

// dq/du = (u x n)/|u|^2, dq/dv = (n x v)/|v|^2 with n the unit normal along u x v.
struct CornerAngle {
    static constexpr int nodes = 3;
    static Coordinate<3> at(const std::array<Vec3, 3>& x) {
        const Vec3 u = x[1] - x[0], v = x[2] - x[0];
        const Vec3 normal = u.cross(v);
        const double sine = normal.norm();
        const double angle = std::atan2(sine, u.dot(v));
        if (sine == 0) {
            return {angle, {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}};
        }
        const Vec3 gu = u.cross(normal) / (sine * u.squaredNorm());
        const Vec3 gv = normal.cross(v) / (sine * v.squaredNorm());
        return {angle, {-gu - gv, gu, gv}};
    }
};

// With e = b - a and normals n1 = e x (c - a), n2 = (d - a) x e, which have n1 x n2 = -e (n1.(d - a)):
//     q = atan2(-|e| n1.(d - a), n1.n2)
//     dq/dc = -|e| n1/|n1|^2,  dq/dd = -|e| n2/|n2|^2       (a height h = |n|/|e| of each triangle over the edge)
//     dq/db = -(s dq/dc + t dq/dd),  dq/da = -((1-s) dq/dc + (1-t) dq/dd)
// with s, t the feet of the heights on the edge, 0 at a and 1 at b.
struct DihedralAngle {
    static constexpr int nodes = 4;
    static Coordinate<4> at(const std::array<Vec3, 4>& x) {
        const Vec3 e = x[1] - x[0], p = x[2] - x[0], r = x[3] - x[0];
        const Vec3 n1 = e.cross(p), n2 = r.cross(e);
        const double ee = e.squaredNorm(), m1 = n1.squaredNorm(), m2 = n2.squaredNorm();
        const double length = std::sqrt(ee);
        const double angle = std::atan2(-length * n1.dot(r), n1.dot(n2));
        if (m1 == 0 || m2 == 0) {
            return {angle, {Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}};
        }
        const Vec3 gc = (-length / m1) * n1, gd = (-length / m2) * n2;
        const double s = p.dot(e) / ee, t = r.dot(e) / ee;
        return {angle, {(s - 1) * gc + (t - 1) * gd, -s * gc - t * gd, gc, gd}};
    }
};

}  // namespace corpuscle::membrane
