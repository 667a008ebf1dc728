#include "membrane/blockStiffness.hpp"

#include <algorithm>

namespace corpuscle::membrane {

void BlockStiffness::clear() {
    for (auto& row : rows_) {
        for (Block& block : row) {
            block.value.setZero();
        }
    }
    rankOne_.clear();
}

void BlockStiffness::add(std::span<const int> nodes, const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
    for (std::size_t m = 0; m < nodes.size(); ++m) {
        auto& row = rows_[static_cast<std::size_t>(nodes[m])];
        for (std::size_t n = 0; n < nodes.size(); ++n) {
            if (nodes[n] < nodes[m]) continue;
            auto block = std::find_if(row.begin(), row.end(), [&](const Block& b) { return b.column >= nodes[n]; });
            if (block == row.end() || block->column != nodes[n]) {
                block = row.insert(block, {nodes[n], Mat3::Zero()});
            }
            block->value += matrix.block<3, 3>(static_cast<Eigen::Index>(3 * m), static_cast<Eigen::Index>(3 * n));
        }
    }
}

void BlockStiffness::addRankOne(double factor, std::span<const Vec3> gradient) {
    rankOne_.push_back({factor, {gradient.begin(), gradient.end()}});
}

void BlockStiffness::addProduct(double factor, std::span<const Vec3> u, std::span<Vec3> result) const {
    for (std::size_t n = 0; n < rows_.size(); ++n) {
        const Vec3 own = factor * u[n];
        Vec3 sum = Vec3::Zero();
        for (const Block& block : rows_[n]) {
            const auto other = static_cast<std::size_t>(block.column);
            sum.noalias() += block.value * u[other];
            if (other != n) {
                result[other].noalias() += block.value.transpose() * own;
            }
        }
        result[n] += factor * sum;
    }
    for (const RankOne& part : rankOne_) {
        double dot = 0;
        for (std::size_t n = 0; n < u.size(); ++n) {
            dot += part.gradient[n].dot(u[n]);
        }
        for (std::size_t n = 0; n < u.size(); ++n) {
            result[n] += factor * part.factor * dot * part.gradient[n];
        }
    }
}

Mat3 BlockStiffness::diagonal(std::size_t node) const {
    Mat3 sum = Mat3::Zero();
    for (const Block& block : rows_[node]) {
        if (block.column == static_cast<int>(node)) {
            sum += block.value;
        }
    }
    for (const RankOne& part : rankOne_) {
        sum += part.factor * part.gradient[node] * part.gradient[node].transpose();
    }
    return sum;
}

}  // namespace corpuscle::membrane
