// Stiffness matrix of one membrane, stored for many products with vectors: rows of 3 x 3 blocks, and low-rank parts.
// Since the matrix is symmetric and its products are limited by memory bandwidth, only blocks on the diagonal and to
// the right of it are stored. The sparsity pattern is kept from one filling to the next, so that filling the matrix
// again allocates no blocks.
#pragma once
#include "membrane/stiffness.hpp"

namespace corpuscle::membrane {

class BlockStiffness : public Stiffness {
  public:
    explicit BlockStiffness(std::size_t nodes) : rows_(nodes) {}
    void clear();  // all blocks zero, no low-rank parts
    void add(std::span<const int> nodes, const Eigen::Ref<const Eigen::MatrixXd>& matrix) override;
    void addRankOne(double factor, std::span<const Vec3> gradient) override;

    void addProduct(double factor, std::span<const Vec3> u, std::span<Vec3> result) const;  // result += factor K u
    Mat3 diagonal(std::size_t node) const;

  private:
    struct Block {
        int column;
        Mat3 value;
    };
    struct RankOne {
        double factor;
        std::vector<Vec3> gradient;
    };
    std::vector<std::vector<Block>> rows_;  // sorted by column, so that sums do not depend on which element came first
    std::vector<RankOne> rankOne_;
};

}  // namespace corpuscle::membrane
