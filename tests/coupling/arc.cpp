// The middle of a step on the arc, against the known positions of points that turn as a rigid body.
#include "coupling/arc.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

using namespace corpuscle;
using coupling::Arc;

namespace {

struct Points {
    std::vector<Vec3> position, velocity;
};

std::vector<Vec3> cloud(int count) {  // relative to its mean
    std::mt19937 random(7);
    std::uniform_real_distribution<double> in(-1, 1);
    std::vector<Vec3> all;
    Vec3 mean = Vec3::Zero();
    for (int k = 0; k < count; ++k) {
        all.emplace_back(in(random), 0.7 * in(random), 0.4 * in(random));
        mean += all.back() / count;
    }
    for (Vec3& r : all) r -= mean;
    return all;
}

const Vec3 axis = Vec3(0.3, -0.5, 0.8).normalized(), drift(0.2, 0.1, -0.4), off(3, 1, -2);

// For each point of the cloud, which drifts and turns by `angle` in a step of length 1: the middle of its chord, and
// the velocity along the chord.
Points onChord(double angle) {
    Points points;
    for (const Vec3& r : cloud(60)) {
        const auto at = [&](double t) { return Vec3(off + t * drift + Eigen::AngleAxisd(t * angle, axis) * r); };
        points.position.push_back(0.5 * (at(-0.5) + at(0.5)));
        points.velocity.push_back(at(0.5) - at(-0.5));
    }
    return points;
}

double largestDistance(double angle, bool shifted) {
    const Points points = onChord(angle);
    const std::vector<Vec3> exact = cloud(60);
    const Arc arc = Arc::of(points.position, points.velocity, 0.5);
    double largest = 0;
    for (std::size_t k = 0; k < exact.size(); ++k)
        largest = std::max(
            largest, ((shifted ? arc.fromChord(points.position[k]) : points.position[k]) - (off + exact[k])).norm());
    return largest;
}

}  // namespace

TEST(Arc, isOfFourthOrderWhereACellTurnsAsOnePiece) {
    EXPECT_GT(largestDistance(0.2, false), 4e-3);
    EXPECT_LT(largestDistance(0.2, true), 5e-5);
    EXPECT_NEAR(largestDistance(0.4, true) / largestDistance(0.2, true), 16, 0.3);
}

TEST(Arc, isLeftAsItWasEntered) {
    const Points points = onChord(0.7);
    const Arc arc = Arc::of(points.position, points.velocity, 0.5);
    for (const Vec3& x : points.position) EXPECT_LT((arc.toChord(arc.fromChord(x)) - x).norm(), 1e-14);
}

TEST(Arc, isTheChordWhereNothingTurns) {
    Points points;
    for (const Vec3& r : cloud(20))
        for (const double x : {-1, 1})
            for (const double y : {-1, 1})
                for (const double z : {-1, 1}) {  // strain along the axes does not turn a cloud with mirror symmetry
                    const Vec3 d = r.cwiseProduct(Vec3(x, y, z));
                    points.position.push_back(off + d);
                    points.velocity.push_back(drift + Vec3(0.4 * d[0], 0.1 * d[1], -0.5 * d[2]));
                }
    const Arc arc = Arc::of(points.position, points.velocity, 0.5);
    EXPECT_LT(arc.turn.norm(), 1e-15);
    for (const Vec3& x : points.position) EXPECT_EQ(arc.fromChord(x), x);
}
