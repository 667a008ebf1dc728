#include "coupling/densityBalance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "coupling/sphereScene.hpp"

using namespace corpuscle;
using namespace corpuscle::coupling;
using namespace corpuscle::coupling::testing;

namespace {

// Two cells: densities have drifted, differently inside and outside, and the first cell is stretched.
struct Wandered : SphereScene {
    static constexpr double fluidVolume = 14 * 8 * 8;
    NodeExchange exchange;
    DensityBalance balance{fluidVolume, 1};
    Wandered() : SphereScene({14, 8, 8}, {Vec3(3.5, 4, 4), Vec3(10.5, 4, 4)}) {
        moveNodes([](const Vec3& x) -> Vec3 { return x[0] < 7 ? Vec3(3.5 + 1.1 * (x[0] - 3.5), x[1], x[2]) : x; });
        exchange.plan(*system, cells);
        exchange.gather(*system, cells, 0);
        ParticleStore& s = system->store();
        for (std::size_t i = 0; i < s.size(); ++i)
            s.density[i] =
                1 + 0.02 * static_cast<double>(s.side[i]) - 0.01 + 0.005 * std::sin(static_cast<double>(s.id[i]));
    }

    // sum m/rho over sum m/rho0 of a region: the fluid of the given sides, and the given share of the nodes of each
    // cell.
    double expansion(std::vector<std::int64_t> sides, std::vector<double> shareOfNodes) const {
        const ParticleStore& s = system->store();
        double space = 0, mass = 0;
        for (std::size_t i = 0; i < s.size(); ++i) {
            double share = 0;
            if (s.kindOf(i) == Kind::membrane)
                share = shareOfNodes[s.node[i] >= cells[1].firstNode];
            else
                for (const std::int64_t side : sides) share += s.side[i] == side;
            space += share * s.mass[i] / s.density[i], mass += share * s.mass[i];
        }
        return sph::testing::sumOverRanks(space) / sph::testing::sumOverRanks(mass);
    }
    double sphereVolume() const { return cells[1].initialVolume; }
};

}  // namespace

TEST(DensityBalance, densityOfEachRegionFollowsItsVolume) {
    Wandered scene;
    ParticleStore& s = scene.system->store();
    const particles::RealArray before = s.density;
    const double wrong = scene.expansion({1}, {0.5, 0}), outside = Wandered::fluidVolume - 2 * scene.sphereVolume();
    scene.balance.apply(*scene.system, scene.cells);
    EXPECT_NEAR(scene.balance.largest(), std::abs(wrong / 1.1 - 1), 1e-12);
    // The density of all fluid in a region changes by the same factor.
    double factor[3] = {0, 0, 0};
    for (std::size_t i = 0; i < s.size(); ++i) {
        if (s.kindOf(i) != Kind::fluid) continue;
        const double ratio = s.density[i] / before[i];
        double& known = factor[s.side[i]];
        if (known != 0) {
            EXPECT_NEAR(ratio, known, 1e-14);
        }
        known = ratio;
    }
    for (int k = 0; k < 30; ++k) scene.balance.apply(*scene.system, scene.cells);
    EXPECT_NEAR(scene.expansion({1}, {0.5, 0}), 1.1, 1e-12);
    EXPECT_NEAR(scene.expansion({2}, {0, 0.5}), 1, 1e-12);
    EXPECT_NEAR(scene.expansion({0}, {0.5, 0.5}), (outside - 0.1 * scene.sphereVolume()) / outside, 1e-12);
}

TEST(DensityBalance, anOpenCellBelongsToTheOutside) {
    Wandered scene;
    membrane::MembraneSettings laws;
    laws.bonds = choice<membrane::BondLaw>("{type: harmonic, k: 2 N/m}");
    laws.rupture = choice<membrane::RuptureLaw>("{type: bondStretch, limit: 1.05}");
    Cell& first = scene.cells[0];
    const std::vector<Vec3> now = first.membrane.position, rest = scene.start[0];
    first.membrane = membrane::Membrane("sphere", 1, rest, first.membrane.network().triangles(), laws, radius);
    first.membrane.position = now;
    {
        const auto broken = first.membrane.findBroken(0);
        ASSERT_FALSE(broken.empty());
        first.membrane.breakBonds(broken);
        ASSERT_TRUE(first.membrane.network().isOpen());
    }
    for (int k = 0; k < 30; ++k) scene.balance.apply(*scene.system, scene.cells);
    EXPECT_NEAR(scene.expansion({2}, {0, 0.5}), 1, 1e-12);
    EXPECT_NEAR(scene.expansion({0, 1}, {1, 0.5}), 1, 1e-12) << "the volume around the second cell is what it was";
}
