// Interface to which terms add their stiffness, the second derivative of the energy [N/m], element by element.
//
// An element names its nodes; its matrix has three rows and columns for each node, in that order. A term that couples
// all nodes through one scalar (global area, volume) instead adds a multiple of the outer product of a gradient with
// itself, which is never assembled.
#pragma once
#include <Eigen/Sparse>
#include <span>
#include <vector>

#include "core/vec.hpp"

namespace corpuscle::membrane {

class Stiffness {
  public:
    virtual ~Stiffness() = default;
    virtual void add(std::span<const int> nodes, const Eigen::Ref<const Eigen::MatrixXd>& matrix) = 0;
    virtual void addRankOne(double factor, std::span<const Vec3> gradient) = 0;  // factor gradient gradient^T
};

// exact: the second derivative, which is indefinite where elements are compressed. semiDefinite: negative eigenvalues
// of each element's matrix are set to zero, so that the sum is positive semi-definite, as conjugate gradients and
// Newton's descent need. partwise: also semi-definite, in a tenth of the time: keeps only those parts of each element
// that are semi-definite in closed form, the curvature of the law and the stiffness of positive tension. This form is
// for the implicit step, which needs a stiffness at every step and whose accuracy does not depend on it.
enum class Definiteness { exact, semiDefinite, partwise };

// The matrix without negative eigenvalues that is nearest to `matrix` in the Frobenius norm.
Eigen::MatrixXd semiDefinite(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

// The complete stiffness of one membrane: a sparse matrix and low-rank parts.
class AssembledStiffness : public Stiffness {
  public:
    explicit AssembledStiffness(std::size_t nodes) : size_(3 * static_cast<int>(nodes)) {}
    void add(std::span<const int> nodes, const Eigen::Ref<const Eigen::MatrixXd>& matrix) override;
    void addRankOne(double factor, std::span<const Vec3> gradient) override;

    struct RankOne {
        double factor;
        Eigen::VectorXd vector;
    };
    const std::vector<RankOne>& rankOne() const { return rankOne_; }
    Eigen::SparseMatrix<double> sparse() const;                 // without the rank-one parts
    Eigen::VectorXd operator*(const Eigen::VectorXd& u) const;  // with them

  private:
    int size_;
    std::vector<Eigen::Triplet<double>> entries_;
    std::vector<RankOne> rankOne_;
};

}  // namespace corpuscle::membrane
