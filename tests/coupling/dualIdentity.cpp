#include "coupling/dualIdentity.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "coupling/sphereScene.hpp"

using namespace corpuscle;
using namespace corpuscle::coupling;
using namespace corpuscle::coupling::testing;

namespace {

// A stretched cell across a periodic edge of the box.
struct Stretched : SphereScene {
    DualIdentity coupling{cells, 1, DensityBalance(12 * 8 * 8, 1), {10, 0}};
    Stretched() : SphereScene({12, 8, 8}, {Vec3(6, 0.2, 7.5)}) {
        coupling.moved(*system, 0, true);
        moveNodes(
            [](const Vec3& x) -> Vec3 { return x + Vec3(0.1 * (x[0] - 6), -0.08 * x[1], 0.05 * std::sin(x[0])); });
        system->rebuild();
        coupling.moved(*system, 0, true);
    }
};

Vec3 force(const ParticleStore& s, std::size_t i) { return s.mass[i] * Vec3(s.fx[i], s.fy[i], s.fz[i]); }

}  // namespace

TEST(DualIdentity, totalForceOfFluidAndMembraneIsZero) {
    Stretched scene;
    ParticleSystem& system = *scene.system;
    sph::FluidForces forces(sph::testing::model("wendlandC2"), system);
    ParticleStore& s = system.store();
    for (std::size_t i = 0; i < s.size(); ++i) {
        s.density[i] = 1 + 0.01 * std::sin(static_cast<double>(s.id[i]));
        s.setVelocity(i, Vec3(std::sin(s.x[i]), std::cos(s.y[i]), 0.2));
    }
    forces.evaluate(system, 0);
    const ParticleStore fluidOnly = s;
    scene.coupling.addAccelerations(system);
    Vec3 total = Vec3::Zero();
    double magnitude = 0, added = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        total += force(s, i);
        magnitude += force(s, i).norm();
        const double change = (force(s, i) - force(fluidOnly, i)).norm();
        if (s.kindOf(i) != Kind::membrane) {
            EXPECT_EQ(change, 0);
        }
        added += change;
    }
    MPI_Allreduce(MPI_IN_PLACE, total.data(), 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_LT(total.norm(), 1e-13 * sph::testing::sumOverRanks(magnitude));
    EXPECT_GT(sph::testing::sumOverRanks(added), 1) << "the membrane is stretched";
}

TEST(DualIdentity, nodesFeelTheNetworksForceOverTheirMass) {
    Stretched scene;
    ParticleStore& s = scene.system->store();
    for (auto* a : {&s.fx, &s.fy, &s.fz}) std::fill(a->begin(), a->end(), 0.5);
    scene.coupling.addAccelerations(*scene.system);
    membrane::Membrane& expected = scene.cells[0].membrane;
    {
        auto x = scene.start[0];
        for (Vec3& p : x) p += Vec3(0.1 * (p[0] - 6), -0.08 * p[1], 0.05 * std::sin(p[0]));
        for (std::size_t n = 0; n < x.size(); ++n) EXPECT_LT((expected.position[n] - x[n]).norm(), 1e-13);
        expected.computeForces();
    }
    for (std::size_t i = 0; i < s.size(); ++i)
        if (s.node[i] >= 0) {
            EXPECT_LT((Vec3(s.fx[i] - 0.5, s.fy[i] - 0.5, s.fz[i] - 0.5) - expected.force[s.node[i]] / nodeMass).norm(),
                      1e-12);
        }
}

TEST(DualIdentity, springRateIsTheLargestEigenvalueOfStiffnessOverMass) {
    Stretched scene;
    const double rate2 = scene.coupling.springRate2(*scene.system, 200);
    double other = rate2;
    MPI_Bcast(&other, 1, MPI_DOUBLE, 0, MPI_COMM_WORLD);
    EXPECT_EQ(other, rate2) << "known to all ranks";

    membrane::Membrane& m = scene.cells[0].membrane;
    const auto n = static_cast<Eigen::Index>(m.position.size());
    Eigen::MatrixXd K(3 * n, 3 * n);
    constexpr double step = 1e-5;
    for (Eigen::Index c = 0; c < 3 * n; ++c) {
        double& x = m.position[static_cast<std::size_t>(c / 3)][c % 3];
        const double at = x;
        for (const double sign : {1.0, -1.0}) {
            x = at + sign * step;
            m.computeForces();
            for (Eigen::Index r = 0; r < 3 * n; ++r) {
                const double force = m.force[static_cast<std::size_t>(r / 3)][r % 3];
                K(r, c) = sign > 0 ? -force : (K(r, c) + force) / (2 * step);
            }
        }
        x = at;
    }
    const double exact =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues()[3 * n - 1] / nodeMass;
    EXPECT_NEAR(rate2, exact, 0.01 * exact);
}

TEST(DualIdentity, membraneRateIsTheLargestEigenvalueOfItsViscosityOverMass) {
    Stretched scene;
    EXPECT_EQ(scene.coupling.membraneRate(*scene.system, 200), 0) << "this membrane has no viscosity";
    membrane::MembraneSettings laws = scene.cells[0].membrane.laws();
    laws.viscosity = {0.3, 0.5};
    membrane::Membrane& m = scene.cells[0].membrane;
    membrane::Membrane viscous(m.name, m.cell, m.network().stressFree(), m.network().triangles(), laws, 1);
    viscous.position = m.position, viscous.velocity = m.velocity;
    m = std::move(viscous);
    const double rate = scene.coupling.membraneRate(*scene.system, 200);

    const auto n = static_cast<Eigen::Index>(m.position.size());
    Eigen::MatrixXd C(3 * n, 3 * n);
    for (Eigen::Index c = 0; c < 3 * n; ++c) {
        std::vector<Vec3> v(m.position.size(), Vec3::Zero()), f = v;
        v[static_cast<std::size_t>(c / 3)][c % 3] = 1;
        m.addViscousForces(v, f);
        for (Eigen::Index r = 0; r < 3 * n; ++r) C(r, c) = -f[static_cast<std::size_t>(r / 3)][r % 3];
    }
    const double exact =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(C, Eigen::EigenvaluesOnly).eigenvalues()[3 * n - 1] / nodeMass;
    EXPECT_NEAR(rate, exact, 0.01 * exact);
}
