// Basis functions b of the weights of nodes, and the conditions on these weights (nodeFluidMap.hpp): with
// q = (x_j - x_m)/R, z = q.n across the membrane and rho^2 = q^2 - z^2 along it,
//
//     b = (1, q, phi(z), rho^2),   phi(z) = E|z - y|
// y: a random position with the probability density m(y), which is W(q) (c0 + c2 q^2) integrated over the planes
// z = y, with integral 1 and second moment 0.1. The exact velocity has a kink |z| at a membrane that exerts a
// tangential force; phi is |z| rounded off, since the force is spread by weights of this kind. W is Wendland's C2
// function, and m and phi are polynomials in |z| for |z| <= 1.
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
    // Values that sum_j w b must have for weights W (c.b): 1 for b_0, 0 for q, the given ones for phi and rho^2.
    static Vector conditions(double kink, double alongSquare) { return {1, 0, 0, 0, kink, alongSquare}; }
    static Vector derivative(int axis) { return Vector::Unit(1 + axis); }  // the same for weights of R d/dx
};

}  // namespace corpuscle::coupling
