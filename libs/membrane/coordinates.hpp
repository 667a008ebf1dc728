// Internal coordinates of a membrane: scalar functions q of a few node positions, with their gradients. A law E(q) of
// one scalar (harmonic, ...) obtains its forces from them: F_n = -E'(q) dq/dx_n.
//
// coordinate    | nodes                                      | value
// BondLength    | a, b                                       | l = |x_b - x_a| [m]
// CornerAngle   | apex o, left u, right v                    | angle between u - o and v - o, 0 .. pi [rad]
// DihedralAngle | edge a, b; c left of a->b, d right of it   | angle between the normals of (a,b,c) and (b,a,d),
//               | (seen from outside)                        | -pi .. pi, positive where convex [rad]
//
// Angles are computed as atan2(|sin|, cos), so that their gradients stay accurate near 0 and pi (no division by sin).
// With slope = E'(q), addTension adds the part of slope d2q/dx2 that is positive semi-definite in closed form: the
// resistance of a bond under tension to being turned (none for angles). Where an angle's plane is undefined (corner
// angle exactly 0 or pi, triangle without area) the gradient is zero.
#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "core/vec.hpp"

namespace corpuscle::membrane {

// Scalar: double, or a type that carries derivatives (hessian.hpp).
template <class Scalar>
using Vec3Of = Eigen::Matrix<Scalar, 3, 1>;

template <int N, class Scalar = double>
struct Coordinate {
    Scalar value;
    std::array<Vec3Of<Scalar>, N> gradient;
};

// Whether an element keeps only a share of its energy where the sheet is weakened (network.hpp). Lips of a tear that
// touch press on each other with full stiffness, so a bond does so in tension only; bending stays until a triangle
// breaks.
enum class Weakening { never, inTension, always };

struct BondLength {
    static constexpr int nodes = 2;
    static constexpr Weakening weakening = Weakening::inTension;
    template <class Scalar = double>
    static Coordinate<2, Scalar> at(const std::array<Vec3Of<Scalar>, 2>& x) {
        using Vec = Vec3Of<Scalar>;
        using std::sqrt;
        const Vec r = x[1] - x[0];
        const Scalar l = sqrt(r.squaredNorm());
        const Vec e = l > 0 ? Vec(r / l) : Vec(Vec::Zero());
        return {l, {-e, e}};
    }
    template <class Matrix>
    static void addTension(const Coordinate<2>& q, double slope, Matrix& matrix) {
        if (!(slope > 0) || !(q.value > 0)) {
            return;
        }
        const Vec3& e = q.gradient[1];
        const Eigen::Matrix3d across = slope / q.value * (Eigen::Matrix3d::Identity() - e * e.transpose());
        matrix.template topLeftCorner<3, 3>() += across;
        matrix.template bottomRightCorner<3, 3>() += across;
        matrix.template topRightCorner<3, 3>() -= across;
        matrix.template bottomLeftCorner<3, 3>() -= across;
    }
};

// The length of a bond at the rim of a hole.
struct RimLength : BondLength {
    static constexpr Weakening weakening = Weakening::never;
};

// dq/du = (u x n)/|u|^2, dq/dv = (n x v)/|v|^2 with n the unit normal along u x v.
struct CornerAngle {
    static constexpr int nodes = 3;
    static constexpr Weakening weakening = Weakening::always;
    template <class Matrix>
    static void addTension(const Coordinate<3>&, double, Matrix&) {}
    template <class Scalar = double>
    static Coordinate<3, Scalar> at(const std::array<Vec3Of<Scalar>, 3>& x) {
        using Vec = Vec3Of<Scalar>;
        using std::atan2, std::sqrt;
        const Vec u = x[1] - x[0], v = x[2] - x[0];
        const Vec normal = u.cross(v);
        const Scalar square = normal.squaredNorm();
        if (!(square > 0)) {
            const Scalar angle = u.dot(v) < 0 ? Scalar(std::numbers::pi) : Scalar(0);
            return {angle, {Vec::Zero(), Vec::Zero(), Vec::Zero()}};
        }
        const Scalar sine = sqrt(square);
        const Scalar angle = atan2(sine, u.dot(v));
        const Vec gu = u.cross(normal) / (sine * u.squaredNorm());
        const Vec gv = normal.cross(v) / (sine * v.squaredNorm());
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
    static constexpr Weakening weakening = Weakening::never;
    template <class Matrix>
    static void addTension(const Coordinate<4>&, double, Matrix&) {}
    template <class Scalar = double>
    static Coordinate<4, Scalar> at(const std::array<Vec3Of<Scalar>, 4>& x) {
        using Vec = Vec3Of<Scalar>;
        using std::atan2, std::sqrt;
        const Vec e = x[1] - x[0], p = x[2] - x[0], r = x[3] - x[0];
        const Vec n1 = e.cross(p), n2 = r.cross(e);
        const Scalar ee = e.squaredNorm(), m1 = n1.squaredNorm(), m2 = n2.squaredNorm();
        if (!(m1 > 0) || !(m2 > 0)) {
            return {Scalar(0), {Vec::Zero(), Vec::Zero(), Vec::Zero(), Vec::Zero()}};
        }
        const Scalar length = sqrt(ee);
        const Scalar angle = atan2(Scalar(-length * n1.dot(r)), Scalar(n1.dot(n2)));
        const Vec gc = n1 * Scalar(-length / m1), gd = n2 * Scalar(-length / m2);
        const Scalar s = p.dot(e) / ee, t = r.dot(e) / ee;
        return {angle, {Vec(gc * Scalar(s - 1) + gd * Scalar(t - 1)), Vec(gc * Scalar(-s) - gd * t), gc, gd}};
    }
};

}  // namespace corpuscle::membrane
