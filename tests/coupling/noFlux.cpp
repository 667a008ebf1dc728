#include "coupling/noFlux.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "coupling/immersed.hpp"
#include "coupling/sphereScene.hpp"

using namespace corpuscle;
using namespace corpuscle::coupling;
using namespace corpuscle::coupling::testing;

namespace {

const Vec3 centre(6, 3.5, 0.4);  // the sphere lies across the face z = 0

struct Near {
    double chi;
    Vec3 normal, velocity;
};

struct Watched : SphereScene {
    NoFlux noFlux{cells, 1};
    Watched() : SphereScene({12, 8, 8}, {centre}, true) {
        for (std::size_t n = 0; n < start[0].size(); ++n) {
            cells[0].membrane.velocity[n] = flow(start[0][n]);
            cells[0].membrane.position[n] += Vec3(24, -8, 0);  // some periods away
        }
        ParticleStore& s = system->store();
        for (std::size_t i = 0; i < s.size(); ++i) s.side[i] = nearest(i).second < 0;
        find();
        noFlux.keepSides(*system);
        EXPECT_EQ(noFlux.crossings(), 0) << "nobody is on the wrong side yet";
        find();
    }
    static Vec3 flow(const Vec3& x) { return {0.3 * x[1], 1 - 0.2 * x[2], 0.1 * x[0]}; }
    void find() {
        std::vector<int> every(system->store().size());
        for (std::size_t i = 0; i < every.size(); ++i) every[i] = static_cast<int>(i);
        noFlux.findAmong(*system, 0, [&](std::size_t) { return every; });
    }
    Vec3 fromCentre(std::size_t i) const {
        return system->periodicity().shortest(system->store().position(i) - centre);
    }

    // Nearest point of the mesh, from a search over all triangles, and the particle's distance from it, positive
    // outside.
    std::pair<Vec3, double> nearest(std::size_t i) const {
        const Vec3 x = fromCentre(i) + centre;
        double best = std::numeric_limits<double>::infinity();
        Vec3 at = x;
        for (const Index3& t : cells[0].membrane.network().triangles()) {
            const Vec3 &a = start[0][t[0]], &b = start[0][t[1]], &c = start[0][t[2]];
            const Vec3 w = geometry::nearestWeights(x, a, b, c), p = w[0] * a + w[1] * b + w[2] * c;
            if ((x - p).norm() < best) best = (x - p).norm(), at = p;
        }
        return {at, (x - at).dot(at - centre) > 0 ? best : -best};
    }
    // Index of the fluid particle of this side nearest to the membrane, on the rank that owns it; -1 on other ranks.
    int nearestOf(int side) const {
        const ParticleStore& s = system->store();
        struct {
            double value;
            int rank;
        } least{std::numeric_limits<double>::infinity(), 0};
        int found = -1;
        for (std::size_t i = 0; i < s.size(); ++i)
            if (const double gap = std::abs(nearest(i).second); s.side[i] == side && gap < least.value)
                least.value = gap, found = static_cast<int>(i);
        MPI_Comm_rank(MPI_COMM_WORLD, &least.rank);
        const int self = least.rank;
        MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE_INT, MPI_MINLOC, MPI_COMM_WORLD);
        return least.rank == self ? found : -1;
    }
    // Moves a particle to this distance from the membrane, along the normal at its nearest point.
    void put(int particle, double distance) {
        if (particle < 0) return;
        const auto i = static_cast<std::size_t>(particle);
        const auto [at, now] = nearest(i);
        const Vec3 x = fromCentre(i) + centre;
        system->store().setPosition(i, system->store().position(i) + (distance / now - 1) * (x - at));
    }
    double crossings() const { return sph::testing::sumOverRanks(static_cast<double>(noFlux.crossings())); }
};

class Sides : public ::testing::TestWithParam<int> {};

}  // namespace

TEST(NoFlux, findsWhatIsNearWithDistanceNormalAndVelocity) {
    Watched scene;
    std::map<int, Near> near;
    scene.noFlux.forNear([&](int particle, double, double chi, const Vec3& normal, const Vec3& velocity) {
        EXPECT_TRUE(near.insert({particle, {chi, normal, velocity}}).second) << "once";
    });
    double found = 0;
    for (std::size_t i = 0; i < scene.system->store().size(); ++i) {
        const auto [at, distance] = scene.nearest(i);
        const auto entry = near.find(static_cast<int>(i));
        EXPECT_EQ(entry != near.end(), std::abs(distance) < 1);
        if (entry == near.end()) continue;
        const auto& [chi, normal, velocity] = entry->second;
        EXPECT_NEAR(chi, std::pow(1 - distance * distance, 2), 1e-12);
        EXPECT_LT((normal - (scene.fromCentre(i) + centre - at) / distance).norm(), 1e-9);
        EXPECT_GT(normal.dot(at - centre), 0) << "outwards";
        EXPECT_LT((velocity - Watched::flow(at)).norm(), 1e-12);
        ++found;
    }
    EXPECT_GT(sph::testing::sumOverRanks(found), 50);
}

TEST_P(Sides, aParticleBeyondTheMembraneGoesBackAndIsCounted) {
    const int side = GetParam();
    const double own = side == 1 ? -1 : 1;
    Watched scene;
    const int i = scene.nearestOf(side);
    scene.put(i, -0.4 * own);
    const double depth = i < 0 ? 0 : std::abs(scene.nearest(static_cast<std::size_t>(i)).second);
    const ParticleStore before = scene.system->store();
    scene.noFlux.keepSides(*scene.system);
    EXPECT_EQ(scene.crossings(), 1);
    const ParticleStore& s = scene.system->store();
    for (std::size_t k = 0; k < s.size(); ++k) {
        const double distance = own * scene.nearest(k).second;
        if (static_cast<int>(k) == i) {
            EXPECT_NEAR(distance, 0.05, 1e-9);
            EXPECT_LT((s.position(k) - before.position(k)).norm(), 0.46) << "no jump to another image";
            EXPECT_NEAR(scene.noFlux.deepest(), depth, 1e-9);
        } else {
            EXPECT_LT((s.position(k) - before.position(k)).norm(), 1e-12);
        }
    }
    scene.noFlux.keepSides(*scene.system);
    EXPECT_EQ(scene.crossings(), 1) << "it stays";
}

TEST_P(Sides, aParticleTooCloseOnItsOwnSideIsMovedNotCounted) {
    const int side = GetParam();
    const double own = side == 1 ? -1 : 1;
    Watched scene;
    const int i = scene.nearestOf(side);
    scene.put(i, 0.01 * own);
    scene.noFlux.keepSides(*scene.system);
    EXPECT_EQ(scene.crossings(), 0);
    EXPECT_EQ(scene.noFlux.deepest(), 0);
    if (i >= 0) {
        EXPECT_NEAR(own * scene.nearest(static_cast<std::size_t>(i)).second, 0.05, 1e-9);
    }
}

// In a gap that is too narrow for the distance from both sheets, a particle goes to the middle and stays there; without
// regard to the other sheet it would be moved to and fro.
TEST(NoFlux, aParticleBetweenTwoSheetsGoesToTheMiddle) {
    Watched scene;
    constexpr double gap = 0.06;
    for (Vec3& x : scene.cells[0].membrane.position) x[2] = centre[2] + gap / (2 * radius) * (x[2] - centre[2]);
    const int particle = scene.nearestOf(1);
    const auto i = static_cast<std::size_t>(std::max(particle, 0));
    const auto height = [&] { return scene.fromCentre(i)[2]; };
    for (const double above : {-0.01, 0.02, 0.05}) {  // the last is beyond the upper sheet
        if (particle >= 0) scene.system->store().setPosition(i, centre + Vec3(0.1, 0.05, above));
        scene.find();
        for (int step = 0; step < 2; ++step) {
            scene.noFlux.keepSides(*scene.system);
            if (particle >= 0) {
                EXPECT_NEAR(height(), 0, 0.02 * gap) << above << ", step " << step;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(InAndOut, Sides, ::testing::Values(0, 1));

// Particles beside whole triangles of a torn cell keep the side on which they are, not that where they started;
// particles within its hole are left alone.
TEST(NoFlux, keepsTheSidesOfATornCellBesideItsHole) {
    Watched scene;
    membrane::Membrane& m = scene.cells[0].membrane;
    std::vector<char> alive(m.network().allBonds().size(), 1);
    const int lost = 12;  // the triangles around this node
    for (const membrane::Bond& bond : m.network().allBonds())
        if (bond.node[0] == lost || bond.node[1] == lost) alive[static_cast<std::size_t>(bond.number)] = 0;
    m.restore(alive);
    ParticleStore& s = scene.system->store();
    for (std::int64_t& side : s.side) side = 0;  // as if all were from outside
    scene.find();
    std::vector<char> isNear(s.size(), 0);
    scene.noFlux.forNear([&](int particle, double side, double, const Vec3& normal, const Vec3&) {
        const auto i = static_cast<std::size_t>(particle);
        isNear[i] = 1;
        EXPECT_EQ(side, scene.nearest(i).second < 0 ? -1 : 1);
        EXPECT_GT(normal.dot(scene.fromCentre(i)), 0);
    });
    double beside = 0, within = 0;
    const ParticleStore before = s;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const auto [at, distance] = scene.nearest(i);
        if (std::abs(distance) >= 1) continue;
        double gap = 1e9;  // of the nearest point from the whole triangles
        for (const int t : m.network().wholeTriangles()) {
            const Index3& n = m.network().triangles()[static_cast<std::size_t>(t)];
            const Vec3 &a = scene.start[0][n[0]], &b = scene.start[0][n[1]], &c = scene.start[0][n[2]];
            const Vec3 w = geometry::nearestWeights(at, a, b, c);
            gap = std::min(gap, (at - w[0] * a - w[1] * b - w[2] * c).norm());
        }
        if (gap > 1e-9) {
            EXPECT_FALSE(isNear[i]) << "within the hole";
            ++within;
        } else if ((scene.start[0][lost] - at).norm() > 1.2) {
            EXPECT_TRUE(isNear[i]);
            ++beside;
        }
        scene.put(static_cast<int>(i), -0.3 * (distance < 0 ? -1 : 1));
    }
    EXPECT_GT(sph::testing::sumOverRanks(within), 2);
    EXPECT_GT(sph::testing::sumOverRanks(beside), 50);
    scene.noFlux.keepSides(*scene.system);
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec3 x = s.position(i);
        s.setPosition(i, before.position(i));
        const double side = scene.nearest(i).second < 0 ? -1 : 1;
        s.setPosition(i, x);
        const auto [at, distance] = scene.nearest(i);
        if (!isNear[i] || (scene.start[0][lost] - at).norm() < 1.2) continue;
        EXPECT_NEAR(side * distance, 0.05, 1e-9);
    }
    EXPECT_GT(scene.crossings(), 50);
}

// A particle that has moved through the membrane on the way to where forces are evaluated belongs to the side from
// where it came.
TEST(NoFlux, takesTheSideOfATornCellFromTheBeginningOfTheStep) {
    Watched scene;
    membrane::Membrane& m = scene.cells[0].membrane;
    std::vector<char> alive(m.network().allBonds().size(), 1);
    alive[3] = 0;
    m.restore(alive);
    std::fill(m.velocity.begin(), m.velocity.end(), Vec3(Vec3::Zero()));
    const int i = scene.nearestOf(1);
    scene.put(i, 0.02);  // outside
    if (i >= 0) {
        const auto [at, distance] = scene.nearest(static_cast<std::size_t>(i));
        const Vec3 outward = (scene.fromCentre(static_cast<std::size_t>(i)) + centre - at) / distance;
        scene.system->store().setVelocity(static_cast<std::size_t>(i), 0.5 * outward);
    }
    std::vector<int> every;
    if (i >= 0) every.push_back(i);
    double found = 0;
    for (const double moved : {0.01, 0.1}) {
        scene.noFlux.findAmong(*scene.system, moved, [&](std::size_t) { return every; });
        scene.noFlux.forNear([&](int, double side, double, const Vec3&, const Vec3&) {
            EXPECT_EQ(side, 0.5 * moved > 0.02 ? -1 : 1);
            ++found;
        });
    }
    EXPECT_EQ(sph::testing::sumOverRanks(found), 2);
}

// The box is 8 spacings wide along y: particles in the gap are within reach of the cell and of its image.
TEST(NoFlux, takesTheNearestImageWhereACellNearlyMeetsItsOwn) {
    Watched scene;
    std::vector<Vec3>& nodes = scene.cells[0].membrane.position;
    for (std::size_t n = 0; n < nodes.size(); ++n) nodes[n][1] = scene.start[0][n][1] * 7.4 / (2 * radius);
    scene.find();
    const geometry::TriangleTree grid({nodes, scene.cells[0].membrane.network().triangles()}, 1);
    int between = 0;
    scene.noFlux.forNear([&](int particle, double, double chi, const Vec3&, const Vec3&) {
        const Vec3 x = scene.system->store().position(static_cast<std::size_t>(particle));
        double least = 1;
        int images = 0;
        for (int n = 0; n < 7 * 7 * 7; ++n) {
            const Vec3 boxes(n % 7 - 3, n / 7 % 7 - 3, n / 49 - 3);
            const geometry::SurfacePoint at = grid.nearest(x + boxes.cwiseProduct(scene.system->box().size()));
            if (!at) continue;
            ++images;
            least = std::min(least, std::abs(at.distance));
        }
        between += images > 1;
        EXPECT_NEAR(chi, std::pow(1 - least * least, 2), 1e-9);
    });
    MPI_Allreduce(MPI_IN_PLACE, &between, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_GT(between, 0);
}

TEST(NoFlux, leavesWallParticlesAlone) {
    Watched scene;
    ParticleStore& s = scene.system->store();
    for (std::int64_t& kind : s.kind) kind = static_cast<std::int64_t>(Kind::wall);
    scene.find();
    scene.noFlux.forNear([](int, double, double, const Vec3&, const Vec3&) { ADD_FAILURE(); });
}
