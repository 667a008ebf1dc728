// What weights of nodes are made of and held to (nodeFluidMap.hpp): q = (x_j - x_m)/R, z = q.n across the membrane and
// rho^2 = q^2 - z^2 along it,
//
//     b = (1, q, phi(z), rho^2),   phi(z) = E|z - y|
// y: a random place whose density m(y) is that of W(q) (c0 + c2 q^2) on the planes across z, with sum 1 and second
// moment 0.1. So phi is |z|, the bend of the velocity where a membrane pulls along it, as weights like these spread its
// force: rounded off. W is Wendland's C2 function, and m and phi are polynomials for |z| <= 1.
#pragma once
#include <Eigen/Core>
#include <array>

#include "core/vec.hpp"

namespace corpuscle::coupling {

struct NodeBasis {
    static constexpr int size = 6;
    using Vector = Eigen::Matrix<double, size, 1>;
    using Matrix = Eigen::Matrix<double, size, size>;

    static double weight(double q) {  // W, not normalised
        const double s = 1 - q, s2 = s * s;
        return (1 + 4 * q) * s2 * s2;
    }
    static double kink(double z);  // phi
    static Vector at(const Vec3& q, const Vec3& normal) {
        const double z = normal.dot(q);
        return {1, q[0], q[1], q[2], kink(z), q.squaredNorm() - z * z};
    }
    // Weights W (c.b) that have 1 for b_0, the kink and rho^2 as given, and 0 for q: conditions of the least squares.
    static Vector conditions(double kink, double alongSquare) { return {1, 0, 0, 0, kink, alongSquare}; }
    static Vector derivative(int axis) { return Vector::Unit(1 + axis); }  // weights of R d/dx
};

}  // namespace corpuscle::coupling
