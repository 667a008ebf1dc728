// Distances and their weights against dense sampling; derivatives against central differences.
#include "contact/gap.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "contact/surfaces.hpp"

namespace corpuscle::contact {
namespace {

using Points = std::array<Vec3, 4>;

Gap triangleGap(const Points& x) { return nodeToTriangle(x[0], x[1], x[2], x[3]); }
Gap edgeGap(const Points& x) { return edgeToEdge(x[0], x[1], x[2], x[3]); }
Gap endGap(const Points& x) { return nodeToEdge(x[0], x[1], x[2]); }

Points randomPoints(Random& random) { return {random.vector(1), random.vector(1), random.vector(1), random.vector(1)}; }

double sampledTriangle(const Points& x) {
    constexpr int n = 200;
    double least = 1e300;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n - i; ++j)
            least =
                std::min(least, (x[0] - x[1] - double(i) / n * (x[2] - x[1]) - double(j) / n * (x[3] - x[1])).norm());
    return least;
}
double sampledEdges(const Points& x) {
    constexpr int n = 200;
    double least = 1e300;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            least =
                std::min(least, (x[2] + double(j) / n * (x[3] - x[2]) - x[0] - double(i) / n * (x[1] - x[0])).norm());
    return least;
}

// The gap vector is the weighted sum of the nodes, with the distance as its length, and weights that add up to 0.
void checkGap(const Gap& gap, const Points& x) {
    Vec3 sum = Vec3::Zero();
    double weights = 0;
    for (std::size_t k = 0; k < 4; ++k) sum += gap.weights[k] * x[k], weights += gap.weights[k];
    EXPECT_NEAR(weights, 0, 1e-14);
    EXPECT_NEAR((sum - gap.distance * gap.normal).norm(), 0, 1e-8);
    if (gap.distance > 0) {
        EXPECT_NEAR(gap.normal.norm(), 1, 1e-12);
    }
}

template <class Distance>
void checkSlope(Distance&& distance, const Points& x, double tolerance) {
    const Gap gap = distance(x);
    constexpr double h = 1e-6;
    for (std::size_t k = 0; k < 4; ++k)
        for (int axis = 0; axis < 3; ++axis) {
            Points up = x, down = x;
            up[k][axis] += h, down[k][axis] -= h;
            const double slope = (distance(up).distance - distance(down).distance) / (2 * h);
            EXPECT_NEAR(slope, gap.weights[k] * gap.normal[axis], tolerance);
        }
}

TEST(Gap, leastDistanceOfRandomPieces) {
    Random random(1);
    for (int n = 0; n < 60; ++n) {
        const Points x = randomPoints(random);
        const Gap triangle = triangleGap(x), edges = edgeGap(x);
        checkGap(triangle, x);
        checkGap(edges, x);
        EXPECT_LE(triangle.distance, sampledTriangle(x) + 1e-12);
        EXPECT_NEAR(triangle.distance, sampledTriangle(x), 0.01);
        EXPECT_LE(edges.distance, sampledEdges(x) + 1e-12);
        EXPECT_NEAR(edges.distance, sampledEdges(x), 0.015);
        EXPECT_NEAR(endGap(x).distance, nodeToTriangle(x[0], x[1], x[2], x[2]).distance, 1e-15);
    }
}

TEST(Gap, slopesOfDistances) {
    Random random(2);
    for (int n = 0; n < 200; ++n) {
        const Points x = randomPoints(random);
        if (triangleGap(x).distance < 0.05 || edgeGap(x).distance < 0.05) continue;
        checkSlope(triangleGap, x, 1e-6);
        checkSlope(edgeGap, x, 1e-5);  // has kinks where the nearest points of nearly parallel edges jump
        checkSlope(endGap, x, 1e-6);
        checkSlope([](const Points& p) { return nodeToNode(p[0], p[1]); }, x, 1e-6);
    }
}

// Degenerate pieces (zero length or area); parallel, nearly parallel and crossing edges; nodes on triangles.
TEST(Gap, degeneratePieces) {
    const Vec3 o(0, 0, 0), e(1, 0, 0), f(0, 1, 0), z(0, 0, 0.5);
    const Points pieces[] = {{z, o, o, o},
                             {z, o, e, e},
                             {z, o, e, 2 * e},
                             {z, e, 2 * e, 3 * e},
                             {o, o, e, f},
                             {0.2 * e, o, e, f},
                             {z, o, e, f},
                             {o, e, z, Vec3(e + z)},
                             {o, e, Vec3(z + 0.3 * e), Vec3(z + 3 * e)},
                             {o, e, z, z},
                             {o, o, z, z},
                             {o, e, Vec3(2 * e), Vec3(3 * e)},
                             {o, e, Vec3(0.5 * e), Vec3(3 * e)},
                             {o, e, z, Vec3(z + e + 1e-9 * f)},
                             {Vec3(-e), e, Vec3(-f), f}};
    for (const Points& x : pieces) {
        for (const Gap& gap : {triangleGap(x), edgeGap(x)}) {
            checkGap(gap, x);
            EXPECT_TRUE(gap.normal.allFinite());
        }
        EXPECT_NEAR(triangleGap(x).distance, sampledTriangle(x), 0.002);
        EXPECT_NEAR(edgeGap(x).distance, sampledEdges(x), 0.002);
    }
    EXPECT_EQ(triangleGap({o, o, e, f}).distance, 0);
    EXPECT_EQ(nodeToTriangle(z, o, e, f).weights[2], 0);
}

TEST(Gap, nearlyParallelEdgesAtEveryAngle) {
    Random random(3);
    for (int n = 0; n < 3000; ++n) {
        const double angle = std::pow(10, random.between(-16, 0)), height = std::pow(10, random.between(-9, -1));
        const Vec3 along(std::cos(angle), std::sin(angle), 0), middle(random.between(-0.3, 0.3), 0, height);
        const Gap gap = edgeToEdge({-0.5, 0, 0}, {0.5, 0, 0}, middle - 0.5 * along, middle + 0.5 * along);
        EXPECT_NEAR(gap.distance, height, 1e-9 * height + 1e-12) << angle;
    }
}

TEST(CrossingFactor, valueAndSlope) {
    Random random(4);
    int inside = 0, partial = 0;
    for (int n = 0; n < 20000 && partial < 200; ++n) {
        Points x = randomPoints(random);
        if (n % 2 == 0) x[3] = x[2] + (x[1] - x[0]) + random.vector(0.3);  // nearly parallel
        const CrossingFactor m = crossingFactor(x[0], x[1], x[2], x[3]);
        EXPECT_GE(m.value, 0);
        EXPECT_LE(m.value, 1);
        if (m.value == 0) continue;
        ++inside;
        partial += m.value < 1;
        const Gap gap = edgeGap(x);
        EXPECT_TRUE(gap.weights[0] * gap.weights[1] * gap.weights[2] * gap.weights[3] != 0) << "both inside";
        constexpr double h = 1e-6;
        for (std::size_t k = 0; k < 4; ++k)
            for (int axis = 0; axis < 3; ++axis) {
                Points up = x, down = x;
                up[k][axis] += h, down[k][axis] -= h;
                const double slope = (crossingFactor(up[0], up[1], up[2], up[3]).value -
                                      crossingFactor(down[0], down[1], down[2], down[3]).value) /
                                     (2 * h);
                EXPECT_NEAR(slope, m.slope[k][axis], 3e-4 * (1 + std::abs(slope)));
            }
    }
    EXPECT_GT(inside, 100);
    EXPECT_EQ(crossingFactor({-1, 0, 0}, {1, 0, 0}, {0, -1, 1}, {0, 1, 1}).value, 1);
    EXPECT_EQ(crossingFactor({-1, 0, 0}, {1, 0, 0}, {-1, 0, 1}, {1, 0, 1}).value, 0);
    EXPECT_EQ(crossingFactor({0, 0, 0}, {0, 0, 0}, {-1, 0, 1}, {1, 0, 1}).value, 0);
}

// The factor goes to zero without a kink where the crossing reaches the end of an edge, and where edges become
// parallel.
TEST(CrossingFactor, endsSmoothly) {
    const auto at = [](double place, double angle) {
        const Vec3 along(std::cos(angle), std::sin(angle), 0), middle(place, 0, 0.1);
        return crossingFactor({0, 0, 0}, {1, 0, 0}, middle - 0.5 * along, middle + 0.5 * along);
    };
    EXPECT_LT(at(1e-4, 1.2).value, 1e-6);
    EXPECT_LT(at(1e-4, 1.2).slope[0].norm(), 2e-2);
    EXPECT_EQ(at(-1e-4, 1.2).value, 0);
    EXPECT_LT(at(0.5, 1e-4).value, 1e-6);
    EXPECT_LT(at(0.5, 1e-4).slope[0].norm(), 1e-2);
    double total = 0;
    constexpr int n = 400;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double angle = (j + 0.5) / n * std::numbers::pi / 2;
            total += at((i + 0.5) / n, angle).value * std::sin(angle) * (1 - endRange);
        }
    EXPECT_NEAR(total / (n * n), crossingMean, 1e-4);
}

}  // namespace
}  // namespace corpuscle::contact
