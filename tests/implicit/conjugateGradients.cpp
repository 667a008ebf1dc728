// Conjugate gradients against a dense solve, with the rows distributed over the ranks.
#include "implicit/conjugateGradients.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

using namespace corpuscle::implicit;

namespace {

constexpr Eigen::Index size = 60;

// A chain of springs, each node tied to the ground with stiffness `hold`: the weaker, the larger the condition number,
// and the smooth modes converge last.
struct Problem {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd b{size}, exact{size};
    Eigen::Index first = 0, count = 0;
    std::vector<int> counts, displacements;

    explicit Problem(double hold = 0.3) {
        std::mt19937_64 random(3);
        std::uniform_real_distribution<double> d(-1, 1);
        for (Eigen::Index i = 0; i < size; ++i) {
            A(i, i) += hold;
            if (i > 0) {
                const double w = std::pow(3, d(random));
                A(i, i) += w, A(i - 1, i - 1) += w, A(i, i - 1) -= w, A(i - 1, i) -= w;
            }
            b[i] = 1 + d(random);
        }
        exact = A.llt().solve(b);
        int rank = 0, ranks = 1;
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        MPI_Comm_size(MPI_COMM_WORLD, &ranks);
        for (int r = 0; r < ranks; ++r) {
            displacements.push_back(static_cast<int>(size) * r / ranks);
            counts.push_back(static_cast<int>(size) * (r + 1) / ranks - displacements.back());
        }
        first = displacements[static_cast<std::size_t>(rank)], count = counts[static_cast<std::size_t>(rank)];
    }
    template <class Field>
    Eigen::VectorXd whole(const Field& part) const {
        const std::vector<double> own(part.begin(), part.end());
        Eigen::VectorXd all(size);
        MPI_Allgatherv(own.data(), static_cast<int>(count), MPI_DOUBLE, all.data(), counts.data(), displacements.data(),
                       MPI_DOUBLE, MPI_COMM_WORLD);
        return all;
    }
    // unsteady: relative amplitude by which the preconditioner varies from row to row and from one application to the
    // next.
    template <class Real>
    Convergence solve(double reference, double tolerance, Eigen::VectorXd& x, double unsteady = 0) const {
        using Field = typename ConjugateGradients<Real>::Field;
        ConjugateGradients<Real> solver;
        const auto n = static_cast<std::size_t>(count);
        Field r(n), part;
        int applications = 0;
        for (std::size_t k = 0; k < n; ++k) r[k] = static_cast<Real>(b[first + static_cast<Eigen::Index>(k)]);
        const Convergence c = solver.solve(
            MPI_COMM_WORLD, r, part, reference, tolerance,
            [&](const Field& z, Field& w) {
                const Eigen::VectorXd product = A * whole(z);
                for (std::size_t k = 0; k < n; ++k)
                    w[k] = static_cast<Real>(product[first + static_cast<Eigen::Index>(k)]);
            },
            [&](const Field& z, Field& w) {
                ++applications;
                for (std::size_t k = 0; k < n; ++k) {
                    const Eigen::Index i = first + static_cast<Eigen::Index>(k);
                    const double share = 1 + unsteady * std::sin(static_cast<double>(7 * i + 3 * applications));
                    w[k] = static_cast<Real>(share * static_cast<double>(z[k]) / std::abs(A(i, i)));
                }
            });
        x = whole(part);
        return c;
    }
    double energy(const Eigen::VectorXd& x) const { return x.dot(A * x); }
};

}  // namespace

TEST(ConjugateGradients, equalTheDenseSolve) {
    const Problem problem;
    Eigen::VectorXd x;
    const Convergence c = problem.solve<double>(0, 1e-10, x);
    EXPECT_TRUE(c.reached);
    EXPECT_LT((x - problem.exact).norm(), 1e-9 * problem.exact.norm());
    EXPECT_NEAR(c.energy, problem.energy(problem.exact), 1e-12 * c.energy);
    EXPECT_LE(c.iterations, size + 5);
}

// The energy of the error is what the solver reports and what stops it.
TEST(ConjugateGradients, stopByTheEnergyOfTheError) {
    const Problem problem;
    const double whole = problem.energy(problem.exact);
    int before = 0;
    for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-5}) {
        Eigen::VectorXd x;
        const Convergence c = problem.solve<double>(0, tolerance, x);
        const double error = problem.energy(problem.exact - x);
        EXPECT_NEAR(c.energy, problem.energy(x), 1e-9 * whole);
        EXPECT_NEAR(c.energy + error, whole, 1e-9 * whole) << "the error is orthogonal to what has been found";
        EXPECT_LE(c.error, tolerance * tolerance * c.energy);
        EXPECT_LT(error, tolerance * tolerance * whole) << tolerance;
        EXPECT_GT(c.iterations, before);
        before = c.iterations;
    }
}

// A uniform error has a residual of only a thousandth of its energy, and the first iterations find little of it: the
// estimate is a lower bound. The error that remains stays below three times the tolerance.
TEST(ConjugateGradients, aSmoothErrorIsHardlyOverlooked) {
    Problem problem(0.003);
    problem.exact.setOnes();
    problem.b = problem.A * problem.exact;
    const double tolerance = 1e-2, reference = problem.energy(problem.exact) / (5 * tolerance * tolerance);
    Eigen::VectorXd x;
    problem.solve<double>(reference, tolerance, x);
    EXPECT_LT(problem.energy(problem.exact - x), 9 * tolerance * tolerance * reference);
}

// A preconditioner that itself iterates varies between applications. This costs iterations but not convergence;
// conjugate gradients whose coefficients assume a fixed preconditioner would reach the iteration limit, or a product of
// the wrong sign.
TEST(ConjugateGradients, bearAPreconditionerThatChanges) {
    const Problem problem;
    Eigen::VectorXd x;
    const int steady = problem.solve<double>(0, 1e-8, x).iterations;
    const Convergence c = problem.solve<double>(0, 1e-8, x, 0.2);
    EXPECT_TRUE(c.reached);
    EXPECT_LT(problem.energy(problem.exact - x), 1e-15 * problem.energy(problem.exact));
    EXPECT_LT(c.iterations, 3 * steady);
    RecordProperty("iterations", fmt::format("{} {}", steady, c.iterations));
}

TEST(ConjugateGradients, aLargerReferenceAllowsMore) {
    const Problem problem;
    Eigen::VectorXd x;
    const double reference = 100 * problem.energy(problem.exact);
    const Convergence c = problem.solve<double>(reference, 1e-2, x);
    EXPECT_LT(c.iterations, problem.solve<double>(0, 1e-2, x).iterations);
    EXPECT_LE(c.error, 1e-4 * reference);
}

TEST(ConjugateGradients, inFloat) {
    const Problem problem;
    Eigen::VectorXd x;
    const Convergence c = problem.solve<float>(0, 1e-3, x);
    EXPECT_TRUE(c.reached);
    EXPECT_LT(problem.energy(problem.exact - x), 1e-6 * problem.energy(problem.exact));
}

TEST(ConjugateGradients, nothingToDo) {
    Problem problem;
    problem.b.setZero();
    Eigen::VectorXd x;
    const Convergence c = problem.solve<double>(0, 1e-3, x);
    EXPECT_TRUE(c.reached);
    EXPECT_EQ(c.iterations, 0);
    EXPECT_EQ(x.norm(), 0);
}

TEST(ConjugateGradients, sayWhereAMatrixIsIndefinite) {
    Problem problem;
    problem.A *= -1;
    for (Eigen::Index i = 0; i < size; ++i) problem.A(i, i) += 1;
    Eigen::VectorXd x;
    EXPECT_FALSE(problem.solve<double>(0, 1e-6, x).reached);
}
