// Packed cells: their distances by another method than the packing's, the same places for the same seed, and a failure
// where there is no room.
#include "packing/packing.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "boundary/planeWalls.hpp"
#include "core/error.hpp"
#include "geometry/crossings.hpp"
#include "geometry/evansFung.hpp"
#include "geometry/insideTest.hpp"
#include "geometry/mesher.hpp"
#include "geometry/place.hpp"
#include "geometry/spheroid.hpp"
#include "geometry/triangleTree.hpp"
#include "packing/alignedOrientation.hpp"
#include "packing/randomOrientation.hpp"
#include "particles/box.hpp"

namespace corpuscle::packing {
namespace {

using geometry::TriangleMesh;

constexpr double um = 1e-6;
const RandomOrientation anyhow;

TriangleMesh ball(double radius, double edge) {
    geometry::Sphere shape(radius);
    shape.prepare("");
    return geometry::meshSurface(shape, edge);
}

Packing::Space spaceOf(const particles::Box& box, const boundary::Walls& walls = {}) {
    return {box.low, box.high, box.volume(), box.periodicity(), walls, {}};
}
particles::Box boxOf(const Vec3& size, bool periodicAlongZ) {
    return {-0.5 * size, 0.5 * size, {true, true, periodicAlongZ}};
}

std::vector<TriangleMesh> placed(const std::vector<Packing::Type>& types, const std::vector<Pose>& poses) {
    std::vector<TriangleMesh> all;
    for (const Pose& pose : poses) {
        const TriangleMesh& mesh = types[pose.kind].surface.mesh;
        all.push_back({geometry::Place{pose.centre, pose.axis, 1}.of(mesh.nodes), mesh.triangles});
    }
    return all;
}

// The least distance of a node of one surface from another surface or from an image of its own, with trees over
// triangles; 0 where two surfaces cross or one is inside another.
double leastDistance(const std::vector<TriangleMesh>& surfaces, const Periodicity& period, double within) {
    std::vector<geometry::Bounds> bounds;
    std::vector<geometry::TriangleTree> trees;
    std::vector<geometry::InsideTest> insides;
    for (const TriangleMesh& mesh : surfaces) {
        bounds.push_back(geometry::boundsOf(mesh.nodes));
        trees.emplace_back(mesh, within);
        insides.emplace_back(mesh);
    }
    double least = within;
    const auto look = [&](std::size_t one, std::size_t other, const Vec3& shift) {
        if (insides[one].inside(surfaces[other].nodes.front() + shift)) least = 0;
        for (const Vec3& node : surfaces[other].nodes)
            if (const geometry::SurfacePoint at = trees[one].nearest(node + shift))
                least = std::min(least, std::abs(at.distance));
    };
    for (const geometry::ImagePair& pair : geometry::neighbours(bounds, period, within)) {
        const auto view = [&](std::size_t s) {
            return geometry::SurfaceView{&surfaces[s].nodes, &surfaces[s].triangles};
        };
        if (geometry::crossing(view(pair.first), view(pair.second), pair.shift)) return 0;
        look(pair.first, pair.second, pair.shift);
        look(pair.second, pair.first, -pair.shift);
    }
    return least;
}

// Balls that fill half the volume of a periodic box: their gaps are checked by the distances of their centres.
TEST(Packing, putsBallsApart) {
    const double radius = 2 * um, gap = 0.1 * um;
    const std::vector<Packing::Type> types{{{ball(radius, 0.7 * um)}, 24, &anyhow}};
    const particles::Box box = boxOf(Vec3(11, 12, 12) * um, true);
    Packing packing(types, spaceOf(box), gap);
    const std::vector<Pose> poses = packing.pack(1);
    ASSERT_EQ(poses.size(), 24u);
    const double fraction = 24 * 4.0 / 3 * std::numbers::pi * std::pow(radius, 3) / box.volume();
    EXPECT_GT(fraction, 0.5);
    double least = 1;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            EXPECT_GE(poses[i].centre[k], box.low[k]);
            EXPECT_LT(poses[i].centre[k], box.high[k]);
        }
        for (std::size_t j = 0; j < i; ++j)
            least = std::min(least, box.periodicity().shortest(poses[i].centre - poses[j].centre).norm());
    }
    const double facets = 0.7 * um * 0.7 * um / (3 * radius);  // largest depth of the middle of a facet below the ball
    EXPECT_GT(least, 2 * radius + gap - 2 * facets);
    EXPECT_GE(leastDistance(placed(types, poses), box.periodicity(), um), gap);
}

TriangleMesh redCell() {
    geometry::EvansFung shape;
    shape.prepare("");
    return geometry::meshSurface(shape, 1 * um);
}

std::size_t numberFor(double haematocrit, const TriangleMesh& mesh, double volume) {
    return static_cast<std::size_t>(std::lround(haematocrit * volume / mesh.volume()));
}

// Nearly twice the haematocrit that random insertion reaches, in a periodic box hardly wider than three cells.
TEST(Packing, putsRedCellsAtHaematocrit45) {
    const TriangleMesh cell = redCell();
    const particles::Box box = boxOf(Vec3(14, 14, 14) * um, true);
    const std::vector<Packing::Type> types{{{cell}, numberFor(0.45, cell, box.volume()), &anyhow}};
    ASSERT_EQ(types[0].number, 14u);
    Packing packing(types, spaceOf(box), 0.1 * um);
    double before = 0;
    const std::vector<Pose> poses = packing.pack(1, [&](const Packing::Progress& now) {
        EXPECT_GE(now.scale, before);
        EXPECT_GE(now.leastGap, 0.1 * um);
        before = now.scale;
    });
    EXPECT_EQ(packing.progress().scale, 1);
    EXPECT_GE(leastDistance(placed(types, poses), box.periodicity(), um), 0.1 * um);
}

// Between walls nearer to each other than a cell's diameter: red cells, balls, discs that keep their axes, and a fixed
// ball.
TEST(Packing, mixesTypesBetweenWalls) {
    const particles::Box box = boxOf(Vec3(16, 16, 6) * um, false);
    geometry::Spheroid flat(3.5 * um, 1 * um);
    flat.prepare("");
    AlignedOrientation aligned;
    aligned.axis = Vec3(0, 0, 2);
    const std::vector<Packing::Type> types{{{redCell()}, 4, &anyhow},
                                           {{ball(0.8 * um, 0.4 * um)}, 12, &anyhow},
                                           {{geometry::meshSurface(flat, 0.8 * um)}, 3, &aligned}};
    Packing::Space space = spaceOf(box, boundary::PlaneWalls().place(box));
    space.fixed.push_back(ball(2 * um, 0.7 * um));
    space.fixed.front().translate(Vec3(7.5, 0, 0) * um);  // through the periodic face
    const double gap = 0.1 * um;
    const std::vector<Pose> poses = Packing(types, space, gap).pack(3);
    ASSERT_EQ(poses.size(), 19u);
    std::vector<TriangleMesh> all = placed(types, poses);
    for (const TriangleMesh& mesh : all)
        for (const Vec3& x : mesh.nodes) EXPECT_LE(std::abs(x[2]), 3 * um - gap);
    all.push_back(space.fixed.front());
    EXPECT_GE(leastDistance(all, box.periodicity(), um), gap);
    for (std::size_t c = 0; c < poses.size(); ++c) {
        EXPECT_EQ(poses[c].kind, c < 4 ? 0u : c < 16 ? 1u : 2u);
        if (poses[c].kind == 2) {
            EXPECT_EQ(poses[c].axis, Vec3(Vec3::UnitZ()));
        }
    }
}

// Cells packed with a rough surface keep the gap with the fine one.
TEST(Packing, keepsTheGapOfFineMeshes) {
    geometry::EvansFung shape;
    shape.prepare("");
    const TriangleMesh fine = geometry::meshSurface(shape, 0.45 * um);
    const RoughSurface rough = RoughSurface::of(shape, fine);
    EXPECT_LT(4 * rough.mesh.nodes.size(), fine.nodes.size());
    EXPECT_LT(rough.outside, 0.01 * um);
    EXPECT_LT(rough.mesh.volume(), 1.1 * fine.volume());
    const particles::Box box = boxOf(Vec3(10, 10, 10) * um, true);
    const std::vector<Pose> poses = Packing({{rough, 4, &anyhow}}, spaceOf(box), 0.2 * um).pack(1);
    EXPECT_GE(leastDistance(placed({{{fine}, 4, &anyhow}}, poses), box.periodicity(), um), 0.2 * um);
    EXPECT_EQ(RoughSurface::of(shape, rough.mesh).mesh.nodes, rough.mesh.nodes);
}

TEST(Packing, isRepeatedBySeed) {
    const std::vector<Packing::Type> types{{{redCell()}, 5, &anyhow}};
    const particles::Box box = boxOf(Vec3(12, 12, 12) * um, true);
    const auto pack = [&](unsigned long seed) { return Packing(types, spaceOf(box), 0.1 * um).pack(seed); };
    const std::vector<Pose> first = pack(7), again = pack(7), other = pack(8);
    for (std::size_t c = 0; c < first.size(); ++c) {
        EXPECT_EQ(first[c].centre, again[c].centre);
        EXPECT_EQ(first[c].axis, again[c].axis);
        EXPECT_NE(first[c].centre, other[c].centre);
    }
}

// No arrangement of balls fills 0.8 of space; and there is no room where the gap is as wide as the box.
TEST(Packing, saysWhereThereIsNoRoom) {
    const particles::Box box = boxOf(Vec3(8, 8, 8) * um, true);
    const TriangleMesh one = ball(2 * um, 0.8 * um);
    const std::vector<Packing::Type> many{{{one}, numberFor(0.8, one, box.volume()), &anyhow}};
    const auto refusal = [&](const std::vector<Packing::Type>& types, double gap) -> std::string {
        try {
            Packing(types, spaceOf(box), gap).pack(1);
        } catch (const Failure& failure) {
            EXPECT_EQ(failure.code(), ExitCode::numerics);
            return failure.what();
        }
        return "";
    };
    EXPECT_NE(refusal(many, 0.05 * um).find("stuck at 0.8"), std::string::npos) << refusal(many, 0.05 * um);
    EXPECT_NE(refusal(many, 9 * um).find("no room"), std::string::npos) << refusal(many, 9 * um);
    // A ball that would meet its own image.
    const particles::Box narrow = boxOf(Vec3(3.5, 20, 20) * um, true);
    try {
        Packing({{{one}, 1, &anyhow}}, spaceOf(narrow), 0.05 * um).pack(1);
        ADD_FAILURE() << "a ball of 4 um in a period of 3.5 um";
    } catch (const Failure& failure) {
        EXPECT_NE(std::string(failure.what()).find("stuck at 0.8"), std::string::npos) << failure.what();
    }
}

// Axes are uniform on the sphere: means of the components and of their products.
TEST(RandomOrientation, isIsotropic) {
    Random random(5);
    Vec3 mean = Vec3::Zero();
    Mat3 square = Mat3::Zero();
    constexpr int count = 20000;
    for (int n = 0; n < count; ++n) {
        const Vec3 axis = anyhow.draw(random);
        EXPECT_NEAR(axis.norm(), 1, 1e-12);
        mean += axis / count, square += axis * axis.transpose() / count;
    }
    EXPECT_LT(mean.norm(), 4 / std::sqrt(count));
    EXPECT_LT((square - Mat3::Identity() / 3).norm(), 4 / std::sqrt(count));
}

}  // namespace
}  // namespace corpuscle::packing
