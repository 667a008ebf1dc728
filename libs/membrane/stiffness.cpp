#include "membrane/stiffness.hpp"

#include <Eigen/Eigenvalues>

namespace corpuscle::membrane {

Eigen::MatrixXd semiDefinite(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
    const auto& vectors = solver.eigenvectors();
    return vectors * solver.eigenvalues().cwiseMax(0).asDiagonal() * vectors.transpose();
}

void AssembledStiffness::add(std::span<const int> nodes, const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
    const auto place = [&](int k) { return 3 * nodes[static_cast<std::size_t>(k / 3)] + k % 3; };
    for (int column = 0; column < matrix.cols(); ++column)
        for (int row = 0; row < matrix.rows(); ++row)
            entries_.emplace_back(place(row), place(column), matrix(row, column));
}

void AssembledStiffness::addRankOne(double factor, std::span<const Vec3> gradient) {
    Eigen::VectorXd vector(size_);
    for (std::size_t n = 0; n < gradient.size(); ++n) vector.segment<3>(3 * static_cast<Eigen::Index>(n)) = gradient[n];
    rankOne_.push_back({factor, std::move(vector)});
}

Eigen::SparseMatrix<double> AssembledStiffness::sparse() const {
    Eigen::SparseMatrix<double> matrix(size_, size_);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    return matrix;
}

Eigen::VectorXd AssembledStiffness::operator*(const Eigen::VectorXd& u) const {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(size_);
    for (const auto& entry : entries_) result[entry.row()] += entry.value() * u[entry.col()];
    for (const RankOne& part : rankOne_) result += part.factor * part.vector.dot(u) * part.vector;
    return result;
}

}  // namespace corpuscle::membrane
