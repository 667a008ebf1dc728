#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "geometry/boundsIndex.hpp"
#include "geometry/insideTest.hpp"
#include "geometry/kuchelFackerell.hpp"
#include "geometry/mesher.hpp"
#include "geometry/triangleTree.hpp"

using namespace corpuscle;
using namespace corpuscle::geometry;

namespace {

const KuchelFackerell redCell(8e-6, 2.12e-6, 1e-6);

const TriangleMesh& cell() {
    static const TriangleMesh mesh = [] {
        TriangleMesh m = meshSurface(redCell, 0.4e-6);
        m.rotate(rotationFromZ({0.3, 0.2, 1}));
        return m;
    }();
    return mesh;
}

std::vector<Vec3> randomPoints(int count, double half) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(-half, half);
    std::vector<Vec3> points;
    for (int n = 0; n < count; ++n) points.emplace_back(uniform(random), uniform(random), uniform(random));
    return points;
}

TEST(InsideTest, agreesWithTheWindingNumber) {
    const InsideTest test(cell());
    int inside = 0;
    for (const Vec3& x : randomPoints(3000, 4.5e-6)) {
        const bool truth = windingNumber(cell(), x) > 0.5;
        inside += truth;
        EXPECT_EQ(test.inside(x), truth);
    }
    EXPECT_NEAR(inside / 3000.0, cell().volume() / std::pow(9e-6, 3), 0.03);
}

// Rays that pass exactly through nodes and edges.
TEST(InsideTest, raysThroughNodesAndEdges) {
    const TriangleMesh& mesh = cell();
    const InsideTest test(mesh);
    for (std::size_t n = 0; n < mesh.nodes.size(); n += 3)
        for (const double dz : {-3e-6, -0.3e-6, 0.3e-6, 3e-6}) {
            const Vec3 x = mesh.nodes[n] + Vec3(0, 0, dz);
            EXPECT_EQ(test.inside(x), windingNumber(mesh, x) > 0.5);
        }
    for (const MeshEdge& e : mesh.edges()) {
        const Vec3 x = (mesh.nodes[e.a] + mesh.nodes[e.b]) / 2 - Vec3(0, 0, 0.4e-6);
        EXPECT_EQ(test.inside(x), windingNumber(mesh, x) > 0.5);
    }
}

TEST(WindingNumber, oneInsideZeroOutside) {
    EXPECT_NEAR(windingNumber(cell(), {0, 0, 0}), 1, 1e-12);
    EXPECT_NEAR(windingNumber(cell(), {0, 0, 9e-6}), 0, 1e-12);
}

TEST(TriangleTree, agreesWithBruteForce) {
    const TriangleMesh& mesh = cell();
    const double reach = 0.7e-6;
    const TriangleTree grid(mesh, reach);
    int within = 0;
    for (const Vec3& x : randomPoints(4000, 4.8e-6)) {
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [i, j, k] : mesh.triangles) {
            const Vec3 w = nearestWeights(x, mesh.nodes[i], mesh.nodes[j], mesh.nodes[k]);
            least = std::min(least, (x - w[0] * mesh.nodes[i] - w[1] * mesh.nodes[j] - w[2] * mesh.nodes[k]).norm());
        }
        const SurfacePoint p = grid.nearest(x);
        ASSERT_EQ(static_cast<bool>(p), least <= reach);
        if (!p) continue;
        ++within;
        EXPECT_NEAR(std::abs(p.distance), least, 1e-18);
        EXPECT_EQ(p.distance<0, windingNumber(mesh, x)> 0.5);
        const Index3& t = mesh.triangles[p.triangle];
        EXPECT_NEAR(p.weights.sum(), 1, 1e-12);
        EXPECT_GE(p.weights.minCoeff(), 0);
        EXPECT_LT((p.weights[0] * mesh.nodes[t[0]] + p.weights[1] * mesh.nodes[t[1]] + p.weights[2] * mesh.nodes[t[2]] -
                   p.point)
                      .norm(),
                  1e-18);
        const SurfacePoint bounded = grid.nearest(x, std::abs(p.distance) * (1 + 1e-12));
        EXPECT_EQ(bounded.triangle, p.triangle);
        EXPECT_EQ(bounded.point, p.point);
        EXPECT_EQ(bounded.distance, p.distance);
        EXPECT_FALSE(grid.nearest(x, std::abs(p.distance) * (1 - 1e-6)));
    }
    EXPECT_GT(within, 300);
}

// A spike: at its tip, the nearest triangle alone would give the wrong side.
TEST(TriangleTree, signAtNodesAndEdges) {
    TriangleMesh spike;
    spike.nodes = {{1, 0, 0}, {-0.5, 0.8, 0}, {-0.5, -0.8, 0}, {3, 0, 6}};
    spike.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    ASSERT_TRUE(checkClosedManifold(spike).empty());
    const TriangleTree grid(spike, 2);
    int nodesAndEdges = 0;
    for (const Vec3& d : randomPoints(4000, 1)) {
        const Vec3 x = spike.nodes[3] + 0.9 * d;
        if (const SurfacePoint p = grid.nearest(x)) {
            EXPECT_EQ(p.distance<0, windingNumber(spike, x)> 0.5);
            nodesAndEdges += p.weights.minCoeff() == 0;
        }
    }
    EXPECT_GT(nodesAndEdges, 500);
}

// Two triangles of a square: its sides and corners are the border, the diagonal is not.
TEST(TriangleTree, knowsTheBorderOfAnOpenMesh) {
    const TriangleMesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    const TriangleTree grid(square, 2);
    const auto isOnBorder = [&](double x, double y) { return grid.isOnBorder(grid.nearest({x, y, 0.3})); };
    EXPECT_FALSE(isOnBorder(0.5, 0.5));
    EXPECT_FALSE(isOnBorder(0.7, 0.2));
    for (const auto& [x, y] : {std::pair{0.5, -0.1}, {1.2, 0.4}, {0.3, 1.2}, {-0.2, 0.6}, {1.1, 1.3}, {-0.1, -0.1}})
        EXPECT_TRUE(isOnBorder(x, y)) << x << " " << y;
    EXPECT_GT(grid.nearest({0.5, 0.5, 0.3}).distance, 0);
    EXPECT_LT(grid.nearest({0.5, 0.5, -0.3}).distance, 0);
    const TriangleTree closed(cell(), 1e-6);
    EXPECT_FALSE(closed.isOnBorder(closed.nearest(cell().nodes[7])));
}

TEST(TriangleTree, followsTheMovedMesh) {
    TriangleMesh mesh = cell();
    TriangleTree grid(mesh, 0.5e-6);
    mesh.translate({20e-6, 0, 0});
    const Vec3 x = mesh.nodes[10] * 1.0;
    EXPECT_FALSE(grid.nearest(x));
    grid.update(mesh.nodes);
    EXPECT_NEAR(grid.nearest(x).distance, 0, 1e-18);
}

// A run that continues from a checkpoint builds its tree from the shape at that time, an uninterrupted run from the
// initial shape: both must give the same answers.
TEST(TriangleTree, answersDoNotDependOnTheTree) {
    TriangleMesh turned = cell();
    for (Vec3& x : turned.nodes) x = {x[1] + 0.3 * x[2], -x[0], 0.7 * x[2] + 0.2 * x[1]};
    const TriangleTree own(cell(), 1e-6);
    TriangleTree moved(turned, 1e-6);
    moved.update(cell().nodes);
    const std::vector<Vec3> away = randomPoints(static_cast<int>(cell().nodes.size()), 0.3e-6);
    // Most points are nearest to a node or an edge that several triangles share.
    for (std::size_t m = 0; m < away.size(); ++m) {
        const SurfacePoint a = own.nearest(cell().nodes[m] + away[m]), b = moved.nearest(cell().nodes[m] + away[m]);
        ASSERT_TRUE(a && b);
        EXPECT_EQ(a.triangle, b.triangle);
        EXPECT_EQ(a.distance, b.distance);
        EXPECT_EQ(a.point, b.point);
        EXPECT_EQ(a.weights, b.weights);
    }
}

// Comparison with all surfaces and all their images; some extend across faces, one is longer than the box, one lies
// several boxes away.
void namesEverySurfaceAroundAPoint(const Vec3& low, const Vec3& high, const Periodicity& period) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> uniform(0, 1);
    const auto vector = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
    std::vector<Bounds> bounds(1);  // the first is empty
    for (int n = 0; n < 40; ++n) {
        const Vec3 corner = low + vector().cwiseProduct(high - low);
        bounds.emplace_back(corner, corner + 1.5 * vector());
    }
    bounds.emplace_back(Vec3(-6, -1, 1), Vec3(6, 0, 2));
    bounds.emplace_back(Vec3(28, -19, 4), Vec3(29, -18, 9));
    for (const double margin : {0.0, 0.4}) {
        const BoundsIndex index(bounds, low, high, period, margin);
        double named = 0, around = 0;
        for (int n = 0; n < 2000; ++n) {
            const Vec3 x = low + vector().cwiseProduct(high - low);
            const std::vector<int>& near = index.near(x);
            EXPECT_TRUE(std::is_sorted(near.begin(), near.end()));
            EXPECT_EQ(index.near(x + Vec3(10, -16, 0)), near);
            for (int s = 1; s < static_cast<int>(bounds.size()); ++s) {
                const Bounds& b = bounds[static_cast<std::size_t>(s)];
                bool is = false;
                period.forImagesWithin(x, b.min() - Vec3::Constant(margin), b.max() + Vec3::Constant(margin),
                                       [&](const Vec3&) { is = true; });
                around += is;
                if (is) {
                    EXPECT_TRUE(std::binary_search(near.begin(), near.end(), s)) << s;
                }
            }
            named += static_cast<double>(near.size());
        }
        EXPECT_LT(named, 12 * around) << "few surfaces are named in vain";
        EXPECT_LT(named, 0.5 * 2000 * static_cast<double>(bounds.size()));
    }
}

TEST(BoundsIndex, namesEverySurfaceAroundAPoint) {
    const Vec3 low(-5, -4, 0), high(5, 4, 6);
    namesEverySurfaceAroundAPoint(low, high, {low, high, {true, true, false}});
    EXPECT_TRUE(BoundsIndex().near(Vec3(1, 2, 3)).empty());
}

TEST(BoundsIndex, namesEverySurfaceWhereImagesSlide) {
    const Vec3 low(-5, -4, 0), high(5, 4, 6);
    for (const double offset : {0.0, 3.7, -4.9}) {
        Periodicity period(low, high, {true, true, true});
        period.slide(2, Vec3(offset, 0, 0), Vec3::Zero());
        namesEverySurfaceAroundAPoint(low, high, period);
    }
}

}  // namespace
