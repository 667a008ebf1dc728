// Contact of nodes with walls: energy and force from the distance of each node, motions that end before a wall.
#include <gtest/gtest.h>

#include "boundary/planeWalls.hpp"
#include "contact/barrier.hpp"
#include "contact/surfaces.hpp"
#include "contact/wallContact.hpp"

namespace corpuscle::contact {
namespace {

struct Between {
    particles::Box box{Vec3(-4, -4, -1.1), Vec3(4, 4, 1.2), {true, true, false}};
    boundary::Walls walls = boundary::PlaneWalls().place(box);
    geometry::TriangleMesh mesh = sphere(1, 2);
    Surface surface{mesh.nodes, mesh.triangles};
    Barrier law;
    Between() { law.length = 0.3, law.strength = 2, law.thickness = 0.02; }
};

// Every node within range of one of the two walls is found once, with the law at its gap; the force is minus the slope
// of the energy.
TEST(WallContact, isThatOfNodes) {
    const Between test;
    const auto energyAt = [&](double lift) {
        double sum = 0;
        for (std::size_t n = 0; n < test.mesh.nodes.size(); ++n) {
            const double z = test.mesh.nodes[n][2] + lift;
            for (const double gap : {z + 1.1 - 0.02, 1.2 - z - 0.02})
                sum += test.surface.nodeArea()[n] * test.law.at(gap).energy;
        }
        return sum;
    };
    double energy = 0, push = 0;
    std::array<int, 2> count{};
    for (const AtWall& at : nodesAtWalls(test.law, test.walls, test.surface, test.mesh.nodes)) {
        energy += at.area * at.psi.energy, push += at.force()[2];
        ++count[static_cast<std::size_t>(at.wall)];
        EXPECT_GT(at.force().dot(at.normal), 0);
    }
    EXPECT_GT(count[0], count[1]);
    EXPECT_GT(count[1], 0);
    EXPECT_NEAR(energy, energyAt(0), 1e-12 * energy);
    constexpr double h = 1e-6;
    EXPECT_NEAR(push, -(energyAt(h) - energyAt(-h)) / (2 * h), 1e-6 * std::abs(push));
}

TEST(WallContact, endsWaysBeforeTheWall) {
    const Between test;
    const auto freeBy = [&](const Vec3& way, double share) {
        const std::vector<Vec3> u(test.mesh.nodes.size(), way);
        return freeOfWalls(test.law, test.walls, test.mesh.nodes, u, share);
    };
    EXPECT_EQ(freeBy({3, 2, 0}, 0.1), 1);
    EXPECT_EQ(freeBy({0, 0, -0.05}, 0.1), 1);
    for (const double way : {-0.1, -1.0, -50.0}) {
        // A tenth of the gap 0.08 is to be left; the motion is checked at eight points.
        const double gone = freeBy({0, 0, way}, 0.1) * -way;
        EXPECT_LE(gone, 0.072 + 1e-12) << way;
        EXPECT_GE(gone, std::max(0.072 + way / 8, 0.0)) << way;
    }
    EXPECT_LT(freeBy({0, 0, 1}, 0.1), 0.18);
    EXPECT_LE(freeBy({0, 0, -0.07}, 0.5) * 0.07, 0.04);
    EXPECT_EQ(freeOfWalls(test.law, {}, test.mesh.nodes, std::vector<Vec3>(test.mesh.nodes.size(), Vec3(0, 0, 9))), 1);
}

}  // namespace
}  // namespace corpuscle::contact
