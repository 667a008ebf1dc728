// Basis functions b of the weights of nodes, and the conditions on these weights (nodeFluidMap.hpp): with
// q = (x_j - x_m)/R, z = q.n across the membrane and rho^2 = q^2 - z^2 along it,
//
//     b = (1, q, phi(z), rho^2),   phi(z) = E|z - y|
// y: a random position with the probability density m(y), which is W(q) (c0 + c2 q^2) integrated over the planes
// z = y, with integral 1 and second moment 0.1. The exact velocity has a kink |z| at a membrane that exerts a
// tangential force; phi is |z| rounded off, since the force is spread by weights of this kind. W is Wendland's C2
// function, and m and phi are polynomials in |z| for |z| <= 1.
//
// Weights of moving least squares grow without bound where the particles lie badly, as with fluid on one side only, or
// are too few. They are then mixed with the plain mean, with the weights V W (Shepard). Its share is a smooth function
// of sum |w|, so that the velocity of a node is continuous in its position. (If the weights were exchanged at once, a
// node at the boundary between the two would be driven from one to the other in each step, with a jump of its velocity
// that does not decrease with the step.)
#pragma once
#include <Eigen/Core>
#include <algorithm>
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
    // Share of the plain mean: 0 up to a sum |w| of 4, 1 from 8 on, and for a sum that is not a number.
    static constexpr double largestExact = 4, largestUsed = 8;
    static double shareOfMean(double sumOfMagnitudes) {
        if (!(sumOfMagnitudes < largestUsed)) return 1;
        const double t = std::max(0.0, (sumOfMagnitudes - largestExact) / (largestUsed - largestExact));
        return t * t * (3 - 2 * t);
    }
    static Vector derivative(int axis) { return Vector::Unit(1 + axis); }  // conditions on weights of R d/dx
};

}  // namespace corpuscle::coupling
