// Free fraction of a motion: the motion ends before pieces meet, and not much earlier than necessary.
#include "contact/travel.hpp"

#include <gtest/gtest.h>

#include "contact/gap.hpp"
#include "contact/surfaces.hpp"

namespace corpuscle::contact {
namespace {

double triangleDistance(const FourNodes& x) { return nodeToTriangle(x[0], x[1], x[2], x[3]).distance; }
double edgeDistance(const FourNodes& x) { return edgeToEdge(x[0], x[1], x[2], x[3]).distance; }

FourNodes moved(const FourNodes& x, const FourNodes& u, double fraction) {
    FourNodes now;
    for (std::size_t k = 0; k < 4; ++k) now[k] = x[k] + fraction * u[k];
    return now;
}

// The fraction at which the distance first falls below `least`, found in many small steps; 1 if it never does.
template <class Distance>
double firstBelow(Distance&& distance, const FourNodes& x, const FourNodes& u, double least) {
    constexpr int n = 20000;
    for (int k = 1; k <= n; ++k)
        if (distance(moved(x, u, double(k) / n)) < least) return double(k - 1) / n;
    return 1;
}

FourNodes random(Random& numbers, double half) {
    return {numbers.vector(half), numbers.vector(half), numbers.vector(half), numbers.vector(half)};
}

TEST(Travel, endsShortlyBeforePiecesMeet) {
    Random numbers(1);
    const Keep keep{0.05, 0.1};
    int met = 0;
    for (int n = 0; n < 100; ++n) {
        const FourNodes x = random(numbers, 1), u = random(numbers, 2);
        for (const bool edges : {false, true}) {
            const auto distance = edges ? edgeDistance : triangleDistance;
            const double start = distance(x);
            if (start <= keep.thickness) continue;
            const double kept = keep.share * (start - keep.thickness);
            const double fraction = edges ? edgeEdgeTravel(x, u, keep) : nodeTriangleTravel(x, u, keep);
            const double truth = firstBelow(distance, x, u, keep.thickness + kept);
            const double later = firstBelow(distance, x, u, keep.thickness + 1.06 * kept);
            EXPECT_LE(fraction, truth + 1e-4);
            EXPECT_GE(fraction, later - 1e-4) << "no shorter than needed";
            met += truth < 1;
        }
    }
    EXPECT_GT(met, 30);
}

TEST(Travel, fastMotionsNeverCross) {
    Random numbers(2);
    int stopped = 0;
    for (int n = 0; n < 20000; ++n) {
        const double size = std::pow(10, numbers.between(-3, 0)), speed = std::pow(10, numbers.between(-3, 3));
        FourNodes x = random(numbers, 1), u = random(numbers, speed);
        if (n % 2 == 0) x[0] = x[1] + size * numbers.vector(0.01);  // starts close
        const double thickness = n % 3 == 0 ? 0 : 1e-4;
        for (const bool edges : {false, true}) {
            const auto distance = edges ? edgeDistance : triangleDistance;
            const double start = distance(x);
            if (start <= thickness) continue;
            const Keep keep{thickness, 0.1};
            const double fraction = edges ? edgeEdgeTravel(x, u, keep) : nodeTriangleTravel(x, u, keep);
            const double least = thickness + 0.1 * (start - thickness);
            EXPECT_GE(fraction, 0);
            EXPECT_LE(fraction, 1);
            for (int k = 1; k <= 20; ++k)
                EXPECT_GE(distance(moved(x, u, fraction * k / 20)), least * (1 - 1e-9) - 1e-12);
            stopped += fraction < 1;
        }
    }
    EXPECT_GT(stopped, 1000);
}

TEST(Travel, specialMotions) {
    const FourNodes above{Vec3(0.2, 0.2, 1), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    const Vec3 down(0, 0, -2), none = Vec3::Zero(), far(30, -20, 10);
    EXPECT_NEAR(nodeTriangleTravel(above, {down, none, none, none}, {}), 0.45, 0.003);
    EXPECT_EQ(nodeTriangleTravel(above, {down, none, none, none}, {}, 0.3), 0.3) << "never more than asked for";
    EXPECT_EQ(nodeTriangleTravel(above, {far, far, far, far}, {}), 1) << "moving together";
    EXPECT_EQ(nodeTriangleTravel(above, {none, none, none, none}, {}), 1);
    // Sliding is free, however small the gap.
    const FourNodes low{Vec3(0.1, 0.2, 1e-9), above[1], above[2], above[3]};
    EXPECT_EQ(nodeTriangleTravel(low, {Vec3(0.6, 0, 0), none, none, none}, {}), 1);
    // A node nearer to the triangle than the thickness can still move away, and does not cross.
    const FourNodes flat{Vec3(0.2, 0.2, 0.01), above[1], above[2], above[3]};
    EXPECT_EQ(nodeTriangleTravel(flat, {Vec3(0, 0, 0.005), none, none, none}, {.thickness = 0.1}), 1);
    EXPECT_NEAR(nodeTriangleTravel(flat, {Vec3(0, 0, -0.02), none, none, none}, {.thickness = 0.1}), 0.45, 0.003);
    const FourNodes touching{Vec3(0.25, 0.25, 0), above[1], above[2], above[3]};
    EXPECT_EQ(nodeTriangleTravel(touching, {down, none, none, none}, {}), 0);
}

}  // namespace
}  // namespace corpuscle::contact
