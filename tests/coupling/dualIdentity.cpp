#include "coupling/dualIdentity.hpp"

#include <gtest/gtest.h>

#include "coupling/sphereScene.hpp"

using namespace corpuscle;
using namespace corpuscle::coupling;
using namespace corpuscle::coupling::testing;

namespace {

// Off centre and across a periodic corner, stretched.
struct Stretched : SphereScene {
    DualIdentity coupling{cells, 1, 10};
    Stretched() : SphereScene({12, 8, 8}, {Vec3(6, 0.2, 7.5)}) {
        coupling.moved(*system, true);
        moveNodes([](const Vec3& x) -> Vec3 { return x + Vec3(0.1 * (x[0] - 6), -0.08 * x[1], 0.05 * std::sin(x[0])); });
        system->rebuild();
        coupling.moved(*system, true);
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
    if (scene.cells[0].held) {
        auto x = scene.start[0];
        for (Vec3& p : x) p += Vec3(0.1 * (p[0] - 6), -0.08 * p[1], 0.05 * std::sin(p[0]));
        for (std::size_t n = 0; n < x.size(); ++n) EXPECT_LT((expected.position[n] - x[n]).norm(), 1e-13);
        expected.computeForces();
    }
    for (std::size_t i = 0; i < s.size(); ++i)
        if (s.node[i] >= 0) {
            EXPECT_LT((Vec3(s.fx[i] - 0.5, s.fy[i] - 0.5, s.fz[i] - 0.5) - expected.force[s.node[i]] / 0.4).norm(), 1e-12);
        }
}

TEST(DualIdentity, stiffestIsKnownToAllRanks) {
    Stretched scene;
    const auto stiffest = scene.coupling.stiffest(*scene.system);
    EXPECT_DOUBLE_EQ(stiffest.leastMass, 0.4);
    EXPECT_GT(stiffest.stiffness, 2) << "at least one bond's constant";
    double other = stiffest.stiffness;
    MPI_Bcast(&other, 1, MPI_DOUBLE, 0, MPI_COMM_WORLD);
    EXPECT_EQ(other, stiffest.stiffness);
}
