#include "boundary/planeWalls.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/registry.hpp"
#include "support/planeWalls.hpp"

namespace corpuscle::boundary {
namespace {

const particles::Box box{Vec3(-3, -2, -1), Vec3(3, 2, 5), {true, false, true}};

Choice<WallShape> shape(const std::string& text) {
    Problems problems;
    auto read = readChoice<WallShape>(parseValue(text, "constant/flow.yaml", problems), problems);
    problems.throwIfAny();
    return read;
}

TEST(PlaneWalls, standAtTheEndsOfTheBox) {
    const auto walls = shape("{type: planes, normal: y}");
    EXPECT_EQ(walls->planesAcross(), 1);
    EXPECT_TRUE(walls->isAcross(1) && !walls->isAcross(0) && !walls->isAcross(2));
    const Walls placed = walls->place(box);
    ASSERT_EQ(placed.count(), 2u);
    EXPECT_EQ(placed[0].name, "lower");
    EXPECT_EQ(placed[1].name, "upper");
    EXPECT_EQ(placed[0].normal(Vec3(1, 1, 1)), Vec3(0, 1, 0));
    EXPECT_EQ(placed[1].normal(Vec3(1, 1, 1)), Vec3(0, -1, 0));
    for (std::size_t n = 0; n < 2; ++n) {
        EXPECT_EQ(placed[n].number, static_cast<int>(n));
        EXPECT_EQ(placed[n].velocity, Vec3(0, 0, 0));
        EXPECT_DOUBLE_EQ(placed[n].surface->area(), 36);
    }
    EXPECT_DOUBLE_EQ(walls->volume(box), 6 * 4 * 6);
    EXPECT_DOUBLE_EQ(walls->volumeBehind(box, Vec3(9, 0.5, 9)), 36);
}

// Walls without `type` are planes; without `normal` they lie across z.
TEST(PlaneWalls, areTheUsualWalls) {
    EXPECT_EQ(shape("{normal: y}")->planesAcross(), 1);
    EXPECT_EQ(shape("{}")->planesAcross(), 2);
    EXPECT_EQ(shape("planes")->planesAcross(), 2);
    EXPECT_THROW(shape("{nromal: y}"), CaseError);
}

TEST(Walls, distanceIsThatOfTheNearest) {
    const Walls walls = testing::planes(2, -1, 5, Vec3(-1, 0, 0), Vec3(2, 0, 0));
    EXPECT_DOUBLE_EQ(walls.distance(Vec3(7, 7, 0)), 1);
    EXPECT_DOUBLE_EQ(walls.distance(Vec3(7, 7, 4.5)), 0.5);
    EXPECT_DOUBLE_EQ(walls.distance(Vec3(7, 7, -3)), -2) << "behind the lower one";
    EXPECT_EQ(walls.nearest(Vec3(7, 7, -3)).number, 0);
    EXPECT_EQ(walls.nearest(Vec3(0, 0, 8)).velocityAt(Vec3(0, 0, 8)), Vec3(2, 0, 0));
    EXPECT_EQ(walls.nearest(Vec3(0, 0, 2)).number, 0) << "in the middle the first";
    EXPECT_EQ(Walls().distance(Vec3(0, 0, 0)), std::numeric_limits<double>::infinity());
}

// A surface that does not implement a loop of its own over many points: a ball with fluid outside.
struct Ball : Surface {
    double distance(const Vec3& x) const override { return x.norm() - 1; }
    Vec3 normal(const Vec3& x) const override { return x.normalized(); }
    double area() const override { return 4 * std::numbers::pi; }
};

TEST(Walls, manyDistancesAtOnceAreThoseOfEach) {
    Walls walls = testing::planes(1, -2, 2);
    walls.add("ball", std::make_shared<Ball>());
    particles::ParticleStore store;
    store.resize(100);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-2.5, 2.5);
    for (std::size_t i = 0; i < store.size(); ++i)
        store.setPosition(i, Vec3(number(random), number(random), number(random)));
    std::vector<double> found(7, 3.0);
    walls.findDistances(pointsOf(store), found);
    ASSERT_EQ(found.size(), store.size());
    bool atBall = false;
    for (std::size_t i = 0; i < store.size(); ++i) {
        const Vec3 x = store.position(i);
        EXPECT_DOUBLE_EQ(found[i], std::min({2 - std::abs(x[1]), x.norm() - 1}));
        EXPECT_DOUBLE_EQ(found[i], walls.distance(x));
        EXPECT_DOUBLE_EQ(found[i], walls.nearest(x).distance(x));
        atBall = atBall || walls.nearest(x).number == 2;
    }
    EXPECT_TRUE(atBall);
}

}  // namespace
}  // namespace corpuscle::boundary
