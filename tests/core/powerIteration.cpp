#include "core/powerIteration.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

namespace corpuscle {
namespace {

double found(const Eigen::Matrix4d& A, Eigen::Vector4d x, int iterations) {
    return largestEigenvalue(
        iterations,
        [&] {
            if (x.norm() == 0) return 0.0;
            x /= x.cwiseAbs().maxCoeff();  // any scale is allowed
            return x.squaredNorm();
        },
        [&] {
            x = A * x;
            return x.squaredNorm();
        });
}

// Comparison with the eigenvalues from Eigen, which are approached from below.
TEST(PowerIteration, findsTheLargestEigenvalue) {
    Eigen::Matrix4d A;
    A << 4, 1, 0, 2, 1, 3, 1, 0, 0, 1, 5, 1, 2, 0, 1, 2;
    const double largest = Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(A).eigenvalues().maxCoeff();
    const Eigen::Vector4d start(1, -1, 1, 1);
    EXPECT_NEAR(found(A, start, 200), largest, 1e-12 * largest);
    EXPECT_LT(found(A, start, 3), largest);
    EXPECT_EQ(found(A, Eigen::Vector4d::Zero(), 3), 0);
    EXPECT_EQ(found(Eigen::Matrix4d::Zero(), start, 3), 0);
}

}  // namespace
}  // namespace corpuscle
