// The largest eigenvalue of the viscous operator, which limits the explicit step.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "sph/samples.hpp"

using namespace corpuscle;
using namespace corpuscle::sph;
using namespace corpuscle::sph::testing;

namespace {

// -W'(r)/r from the kernel family; forces.cpp compares the kernels with the literature.
double slope(const Kernel& kernel, double r, double H) { return kernel.gradientNormalisation(H) * kernel.slope(r / H); }

// Largest eigenvalue of the viscous operator for mu = m = rho = 1, as a dense matrix.
double denseRate(const std::vector<Particle>& all, const Box& box, const Kernel& kernel, double H) {
    const auto n = static_cast<Eigen::Index>(all.size());
    Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
            const double r = box.periodicity().shortest(all[i].x - all[j].x).norm();
            if (i == j || r >= H) continue;
            const double weight = 2 * slope(kernel, r, H) / (all[i].density * all[j].density);
            L(i, i) += weight;
            L(i, j) -= weight;
        }
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(L, Eigen::EigenvaluesOnly).eigenvalues()[n - 1];
}

double rate(const std::vector<Particle>& all, const Index3& n, const std::string& kernel, double H, int iterations) {
    FluidModel fluid = model(kernel);
    fluid.viscosity = 1;
    ParticleSystem system(MPI_COMM_WORLD, cube(n), {}, H, 0.3, 1);
    deal(all, system);
    FluidForces forces(fluid, system);
    return forces.viscousRate(system, iterations);
}

}  // namespace

TEST(ViscousRate, equalsTheDenseEigenvalue) {
    const Index3 n{6, 6, 6};
    const std::vector<Particle> all = lattice(n, 0.2);
    const double exact = denseRate(all, cube(n), *choose<Kernel>("wendlandC2"), 2.4);
    EXPECT_NEAR(rate(all, n, "wendlandC2", 2.4, 400), exact, 1e-3 * exact);
    EXPECT_LE(rate(all, n, "wendlandC2", 2.4, 20), exact * (1 + 1e-12)) << "power iterations approach from below";
    EXPECT_GT(rate(all, n, "wendlandC2", 2.4, 20), 0.9 * exact);
}

// 1/rate in dx^2/nu on the lattice. Source: computed for this project with a prototype, independently of this code; two
// digits.
TEST(ViscousRate, limitsOnTheLattice) {
    struct Row {
        const char* kernel;
        double support, limit;
    };
    for (const Row& row :
         {Row{"lucy", 2.6, 0.33}, {"wendlandC2", 2.8, 0.29}, {"quintic", 2.5, 0.18}, {"quintic", 2.8, 0.22}}) {
        const Index3 n{8, 8, 8};
        EXPECT_NEAR(1 / rate(lattice(n, 0), n, row.kernel, row.support, 200), row.limit, 0.006)
            << row.kernel << " " << row.support;
    }
}

TEST(ViscousRate, leavesTheStateAsItWas) {
    const Index3 n{6, 6, 6};
    ParticleSystem system(MPI_COMM_WORLD, cube(n), {}, 2.3, 0.3, 1);
    deal(lattice(n, 0.1), system);
    FluidForces forces(model("lucy"), system);
    forces.evaluate(system, 0);
    const ParticleStore before = system.store();
    forces.viscousRate(system, 5);
    EXPECT_EQ(before.u, system.store().u);
    EXPECT_EQ(before.fx, system.store().fx);
    EXPECT_EQ(before.densityRate, system.store().densityRate);
}
