// Second derivatives of internal coordinates (coordinates.hpp) by automatic differentiation: their gradients are
// evaluated with numbers that carry first derivatives.
#pragma once
#include <unsupported/Eigen/AutoDiff>

#include "membrane/coordinates.hpp"

namespace corpuscle::membrane {

// Hessian of a coordinate of N nodes with respect to the 3 N components of their positions; exact to rounding.
template <class Coordinate>
Eigen::Matrix<double, 3 * Coordinate::nodes, 3 * Coordinate::nodes> hessian(
    const std::array<Vec3, Coordinate::nodes>& x) {
    constexpr int n = Coordinate::nodes;
    using Derivatives = Eigen::Matrix<double, 3 * n, 1>;
    using Scalar = Eigen::AutoDiffScalar<Derivatives>;
    std::array<Vec3Of<Scalar>, n> seeded;
    for (int k = 0; k < 3 * n; ++k) seeded[k / 3][k % 3] = Scalar(x[k / 3][k % 3], Derivatives::Unit(k));
    const auto q = Coordinate::template at<Scalar>(seeded);
    Eigen::Matrix<double, 3 * n, 3 * n> result;
    for (int k = 0; k < 3 * n; ++k) {
        const Derivatives& row = q.gradient[k / 3][k % 3].derivatives();
        result.row(k) = row.transpose();
    }
    return result;
}

}  // namespace corpuscle::membrane
