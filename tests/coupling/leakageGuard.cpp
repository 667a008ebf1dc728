#include "coupling/leakageGuard.hpp"

#include <gtest/gtest.h>

#include "coupling/dualIdentity.hpp"
#include "coupling/sphereScene.hpp"

using namespace corpuscle;
using namespace corpuscle::coupling;
using namespace corpuscle::coupling::testing;

namespace {

const Vec3 centre(6, 3.5, 0.4);  // the sphere lies across the face z = 0

struct Guarded : SphereScene {
    NodeExchange exchange;
    LeakageGuard guard{1};
    Guarded() : SphereScene({12, 7, 8}, {centre}) {
        exchange.plan(*system, cells);
        exchange.gather(*system, cells, 0);
        guard.findCandidates(*system, cells);
    }
    // Index of the fluid particle of this side that is nearest to the membrane, on the rank that owns it; -1 on other
    // ranks.
    int nearest(int side) const {
        const ParticleStore& s = system->store();
        double best = INFINITY;
        int found = -1;
        for (std::size_t i = 0; i < s.size(); ++i) {
            const double gap = std::abs(distance(i) - radius);
            if (s.kindOf(i) == Kind::fluid && s.side[i] == side && gap < best) best = gap, found = static_cast<int>(i);
        }
        struct {
            double value;
            int rank;
        } least{best, 0};
        MPI_Comm_rank(MPI_COMM_WORLD, &least.rank);
        const int self = least.rank;
        MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE_INT, MPI_MINLOC, MPI_COMM_WORLD);
        return least.rank == self ? found : -1;
    }
    Vec3 outward(std::size_t i) const {
        return system->periodicity().shortest(system->store().position(i) - centre).normalized();
    }
    double distance(std::size_t i) const {
        return system->periodicity().shortest(system->store().position(i) - centre).norm();
    }
    int moves() const { return static_cast<int>(sph::testing::sumOverRanks(static_cast<double>(guard.moves()))); }
};

class Guard : public ::testing::TestWithParam<int> {};  // side that the particle belongs to

}  // namespace

TEST_P(Guard, putsAParticleThrownAcrossTheMembraneBackToItsSide) {
    const int side = GetParam();
    const double own = side == 1 ? -1 : 1;
    Guarded scene;
    ParticleStore& s = scene.system->store();
    scene.guard.movedBack(*scene.system, scene.cells);
    EXPECT_EQ(scene.moves(), 0) << "nobody is on the wrong side yet";

    const int i = scene.nearest(side);
    Vec3 n = Vec3::Zero();
    if (i >= 0) {
        n = scene.outward(i);
        s.setPosition(i, s.position(i) + (radius - own * 0.4 - scene.distance(i)) * n);
        s.setVelocity(i, -own * 3 * n + Vec3(0, 0, 0.25));
    }
    const ParticleStore before = s;
    scene.guard.movedBack(*scene.system, scene.cells);
    EXPECT_EQ(scene.moves(), 1);
    const auto report = scene.guard.takeReport();
    EXPECT_EQ(report.size(), i >= 0 ? 1u : 0u);
    EXPECT_TRUE(scene.guard.takeReport().empty());
    for (std::size_t k = 0; k < s.size(); ++k)
        EXPECT_TRUE(static_cast<int>(k) == i ||
                    (s.position(k) == before.position(k) && s.velocity(k) == before.velocity(k)));
    if (i >= 0 && report.size() == 1) {
        // Facets of the icosphere lie up to 0.06 within the sphere.
        EXPECT_NEAR(own * (scene.distance(i) - radius), 0.1, 0.07);
        EXPECT_LT((s.position(i) - before.position(i)).norm(), 0.7) << "no jump to another image";
        EXPECT_GT(own * s.velocity(i).dot(n), -0.5) << "what ran against the membrane is gone";
        EXPECT_EQ(report[0].particle, s.id[i]);
        EXPECT_EQ(report[0].cell, 1);
        EXPECT_NEAR(report[0].depth, 0.4, 0.07);
        EXPECT_EQ(scene.guard.deepest(), report[0].depth);
    }
    scene.guard.movedBack(*scene.system, scene.cells);
    EXPECT_EQ(scene.moves(), 1) << "it stays";
}

TEST_P(Guard, leavesARupturedCellAlone) {
    const int side = GetParam();
    const double own = side == 1 ? -1 : 1;
    Guarded scene;
    ParticleStore& s = scene.system->store();
    const int i = scene.nearest(side);
    if (i >= 0) s.setPosition(i, s.position(i) + (radius - own * 0.4 - scene.distance(i)) * scene.outward(i));
    std::vector<char> alive(scene.cells[0].membrane.network().allBonds().size(), 1);
    alive[3] = 0;
    scene.cells[0].membrane.restore(alive);
    EXPECT_TRUE(scene.cells[0].membrane.network().isOpen());
    scene.guard.movedBack(*scene.system, scene.cells);
    EXPECT_EQ(scene.moves(), 0);
}

TEST(BreakingCell, isLookedAtOnceMoreBeforeItOpens) {
    Guarded scene;
    membrane::MembraneSettings laws;
    laws.bonds = choice<membrane::BondLaw>("{type: harmonic, k: 2 N/m}");
    laws.rupture = choice<membrane::RuptureLaw>("{type: bondStretch, limit: 1.05}");
    std::vector<Vec3> small = scene.start[0];
    for (Vec3& x : small) x = centre + 0.9 * (x - centre);
    membrane::Membrane& membrane = scene.cells[0].membrane;
    membrane = membrane::Membrane("sphere", 1, small, membrane.network().triangles(), laws, radius);
    membrane.position = scene.start[0];
    DualIdentity coupling(scene.cells, 1, DensityBalance(12 * 7 * 8, 1), {1000, 0});
    coupling.moved(*scene.system, 0, true);
    const int i = scene.nearest(1);
    for (int step = 0; step < 2; ++step) {
        if (i >= 0)
            scene.system->store().setPosition(
                i, scene.system->store().position(i) + (radius + 0.4 - scene.distance(i)) * scene.outward(i));
        const bool broke = !coupling.endStep(*scene.system, 1).empty();
        EXPECT_EQ(broke, step == 0);
        EXPECT_EQ(sph::testing::sumOverRanks(static_cast<double>(coupling.guard().moves())), 1)
            << "the second goes free";
        if (i >= 0) {
            EXPECT_EQ(scene.distance(i) < radius, step == 0);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Sides, Guard, ::testing::Values(1, 0));
