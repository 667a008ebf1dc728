// Candidate pairs of pieces (nodes, edges, triangles) within a distance of each other: all are found, each once, as by
// a search over all pairs.
#include "contact/candidates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>

#include "contact/gap.hpp"
#include "contact/surfaces.hpp"
#include "core/periodicity.hpp"

namespace corpuscle::contact {
namespace {

using NodeTriangle =
    std::tuple<int, int, int, int>;  // pair of surfaces, whether the node is on the second one, node, piece
using EdgeEdge = std::tuple<int, int, int>;

struct Expected {
    std::set<NodeTriangle> triangles, edges, nodes;
    std::set<EdgeEdge> edgePairs;
};

template <std::size_t n>
bool holds(const std::array<int, n>& nodes, int node) {
    return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
}

void expectRows(const Scene& scene, const std::vector<int>& first, int pair, bool back, const geometry::ImagePair& both,
                double within, Expected& all) {
    const std::size_t own = back ? both.second : both.first, other = back ? both.first : both.second;
    const Vec3 offset = back ? both.shift : Vec3(-both.shift);
    const bool isSelf = own == other && both.shift.isZero(0);
    const Surface& target = scene.surfaces[other];
    const auto at = [&](int node) { return scene.x[first[other] + node]; };
    for (int v = 0; v < static_cast<int>(scene.surfaces[own].nodes()); ++v) {
        const Vec3 x = scene.x[first[own] + v] + offset;
        for (int t = 0; t < static_cast<int>(target.triangles().size()); ++t) {
            const Index3& c = target.triangles()[t];
            if (isSelf && holds(c, v)) continue;
            if (nodeToTriangle(x, at(c[0]), at(c[1]), at(c[2])).distance > within) continue;
            all.triangles.insert({pair, back, first[own] + v, t});
            for (const int e : target.sides()[t])
                if (nodeToEdge(x, at(target.edges()[e][0]), at(target.edges()[e][1])).distance <= within) {
                    all.edges.insert({pair, back, first[own] + v, e});
                }
            for (const int n : c)
                if (nodeToNode(x, at(n)).distance <= within) all.nodes.insert({pair, back, first[own] + v, n});
        }
    }
}

Expected bruteForce(const Scene& scene, const std::vector<geometry::ImagePair>& pairs, double within) {
    const std::vector<const Surface*> pointers = scene.pointers();
    const std::vector<int> first = firstNodes(pointers);
    Expected all;
    for (int p = 0; p < static_cast<int>(pairs.size()); ++p) {
        const geometry::ImagePair& both = pairs[p];
        const bool isSelf = both.first == both.second && both.shift.isZero(0);
        expectRows(scene, first, p, false, both, within, all);
        if (!isSelf) expectRows(scene, first, p, true, both, within, all);
        const auto &ones = scene.surfaces[both.first].edges(), &others = scene.surfaces[both.second].edges();
        const auto at = [&](std::size_t surface, int node) { return scene.x[first[surface] + node]; };
        for (int e = 0; e < static_cast<int>(ones.size()); ++e)
            for (int o = isSelf ? e + 1 : 0; o < static_cast<int>(others.size()); ++o) {
                if (isSelf && (holds(ones[e], others[o][0]) || holds(ones[e], others[o][1]))) continue;
                if (edgeToEdge(at(both.first, ones[e][0]), at(both.first, ones[e][1]),
                               at(both.second, others[o][0]) + both.shift, at(both.second, others[o][1]) + both.shift)
                        .distance <= within) {
                    all.edgePairs.insert({p, e, o});
                }
            }
    }
    return all;
}

// What was found, as sorted sets; nothing may be found twice.
Expected collected(const Candidates& found) {
    Expected all;
    for (const NodeRow& row : found.rows) {
        int pair = 0;
        bool back = false;
        for (int p = 0; p < static_cast<int>(found.pairs.size()); ++p) {
            const geometry::ImagePair& both = found.pairs[p];
            const bool forth = row.own == int(both.first) && row.target == int(both.second);
            if (forth && row.offset == -both.shift) pair = p, back = false;
            if (!forth && row.own == int(both.second) && row.target == int(both.first) && row.offset == both.shift) {
                pair = p, back = true;
            }
            if (both.first == both.second && row.own == int(both.first) && row.offset == both.shift &&
                !both.shift.isZero(0)) {
                pair = p, back = true;
            }
        }
        for (int n = row.triangles[0]; n < row.triangles[1]; ++n)
            EXPECT_TRUE(all.triangles.insert({pair, back, row.node, found.triangles[n]}).second) << "each once";
        for (int n = row.edges[0]; n < row.edges[1]; ++n)
            EXPECT_TRUE(all.edges.insert({pair, back, row.node, found.edges[n]}).second);
        for (int n = row.nodes[0]; n < row.nodes[1]; ++n)
            EXPECT_TRUE(all.nodes.insert({pair, back, row.node, found.nodes[n]}).second);
    }
    for (const EdgePair& p : found.edgePairs) EXPECT_TRUE(all.edgePairs.insert({p.pair, p.first, p.second}).second);
    return all;
}

void compare(const Scene& scene, const std::vector<geometry::ImagePair>& pairs, double within, std::size_t atLeast) {
    const std::vector<const Surface*> pointers = scene.pointers();
    const Expected found =
        collected(findCandidates(pointers, scene.x, pairs, std::vector<double>(pairs.size(), within)));
    const Expected expected = bruteForce(scene, pairs, within);
    EXPECT_EQ(found.triangles, expected.triangles);
    EXPECT_EQ(found.edges, expected.edges);
    EXPECT_EQ(found.nodes, expected.nodes);
    EXPECT_EQ(found.edgePairs, expected.edgePairs);
    EXPECT_GE(found.triangles.size(), atLeast);
    EXPECT_GE(found.edgePairs.size(), atLeast);
}

// Two spheres with triangles of different sizes, and a plate of two triangles beside them.
Scene scene() {
    Scene all;
    geometry::TriangleMesh one = sphere(1, 2), other = sphere(1.1, 1), plate;
    other.rotate(geometry::rotationFromZ({0.3, 0.2, 1}));
    other.translate({2.05, 0.1, 0});
    plate.nodes = {{-9, -9, -1.15}, {9, -9, -1.15}, {9, 9, -1.15}, {-9, 9, -1.15}};
    plate.triangles = {{0, 1, 2}, {0, 2, 3}};
    all.add(one), all.add(other), all.add(plate);
    return all;
}

TEST(Candidates, agreeWithAllPairs) {
    const Vec3 none = Vec3::Zero();
    compare(scene(), {{0, 1, none}, {0, 2, none}, {1, 2, none}}, 0.2, 40);
    compare(scene(), {{0, 1, none}}, 3, 10000);
    compare(scene(), {{0, 1, Vec3(0, 9, 0)}}, 0.2, 0);
}

TEST(Candidates, ofASurfaceWithItself) {
    Scene flat = scene();
    for (Vec3& x : flat.x) x.z() *= 0.1;
    compare(flat, {{0, 0, Vec3::Zero()}, {1, 1, Vec3::Zero()}}, 0.15, 300);
}

TEST(Candidates, ofPeriodicImages) {
    Scene all = scene();
    all.surfaces.pop_back();
    all.x.resize(all.x.size() - 4);
    const Periodicity period = Periodicity::centred({4.0, 2.2, 0});
    std::vector<geometry::Bounds> bounds;
    const std::vector<const Surface*> pointers = all.pointers();
    for (std::size_t s = 0; s < 2; ++s) {
        const int first = firstNodes(pointers)[s], last = firstNodes(pointers)[s + 1];
        bounds.push_back(geometry::boundsOf({all.x.begin() + first, all.x.begin() + last}));
    }
    const auto pairs = geometry::neighbours(bounds, period, 0.25);
    EXPECT_GT(pairs.size(), 4U) << "own images among them";
    compare(all, pairs, 0.25, 100);
}

TEST(Candidates, orderDependsOnTheInputAlone) {
    const Scene all = scene();
    const std::vector<const Surface*> pointers = all.pointers();
    const std::vector<geometry::ImagePair> pairs{{0, 1, Vec3::Zero()}, {0, 0, Vec3::Zero()}};
    const Candidates once = findCandidates(pointers, all.x, pairs, std::vector<double>(pairs.size(), 0.3)),
                     again = findCandidates(pointers, all.x, pairs, std::vector<double>(pairs.size(), 0.3));
    EXPECT_EQ(once.triangles, again.triangles);
    for (std::size_t r = 1; r < once.rows.size(); ++r)
        if (once.rows[r].own == once.rows[r - 1].own && once.rows[r].target == once.rows[r - 1].target) {
            EXPECT_LT(once.rows[r - 1].node, once.rows[r].node);
        }
    for (const NodeRow& row : once.rows)
        EXPECT_TRUE(
            std::is_sorted(once.triangles.begin() + row.triangles[0], once.triangles.begin() + row.triangles[1]));
}

TEST(Candidates, surfacesWithoutFinitePlacesAreNearToNothing) {
    Scene all = scene();
    all.x[3].x() = std::numeric_limits<double>::quiet_NaN();
    const std::vector<const Surface*> pointers = all.pointers();
    const std::vector<geometry::ImagePair> pairs{{0, 1, Vec3::Zero()}, {0, 0, Vec3::Zero()}};
    EXPECT_TRUE(findCandidates(pointers, all.x, pairs, std::vector<double>(pairs.size(), 0.3)).rows.empty());
}

TEST(Surface, coefficientsOfOpenAndClosedMeshes) {
    const geometry::TriangleMesh ball = sphere(1, 1);
    const Surface closed(ball.nodes, ball.triangles);
    for (const int c : closed.edgeCoefficient()) EXPECT_EQ(c, -1);
    for (const int c : closed.nodeCoefficient()) EXPECT_EQ(c, 1);
    double nodes = 0, edges = 0;
    for (const double area : closed.nodeArea()) nodes += area;
    for (std::size_t e = 0; e < closed.edges().size(); ++e)
        edges += closed.edgeWidth()[e] * (ball.nodes[closed.edges()[e][0]] - ball.nodes[closed.edges()[e][1]]).norm();
    EXPECT_NEAR(nodes, ball.area(), 1e-12);
    EXPECT_NEAR(edges, ball.area(), 1e-12);

    // A square of two triangles, and a node that belongs to none.
    const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 5, 5}};
    const std::vector<Index3> t{{0, 1, 2}, {0, 2, 3}};
    const Surface open(x, t);
    EXPECT_EQ(open.edges(), (std::vector<Edge>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {2, 3}}));
    EXPECT_EQ(open.edgeCoefficient(), (std::vector<int>{0, -1, 0, 0, 0}));
    EXPECT_EQ(open.nodeCoefficient(), (std::vector<int>{0, 0, 0, 0, 1}));
    EXPECT_EQ(open.nodeArea()[4], 0);
    EXPECT_NEAR(open.meanNodeArea(), 0.25, 1e-15);
}

TEST(Surface, largestReachOfAMesh) {
    const geometry::TriangleMesh ball = sphere(1, 3);
    const double reach = largestReach(ball.nodes, ball.triangles);
    const Surface surface(ball.nodes, ball.triangles);
    double shortest = 1;
    for (const Edge& e : surface.edges()) shortest = std::min(shortest, (ball.nodes[e[0]] - ball.nodes[e[1]]).norm());
    EXPECT_NEAR(reach, 0.4 * shortest, 1e-12);
    const Surface* pointer = &surface;
    const std::vector<geometry::ImagePair> self{{0, 0, Vec3::Zero()}};
    const Candidates found = findCandidates({&pointer, 1}, ball.nodes, self, std::vector<double>{reach});
    EXPECT_TRUE(found.rows.empty());
    EXPECT_TRUE(found.edgePairs.empty());
    const std::vector<Vec3> thin{{0, 0, 0}, {1, 0, 0}, {0.5, 0.01, 0}};
    EXPECT_NEAR(largestReach(thin, std::vector<Index3>{{0, 1, 2}}), 0.008, 1e-12);
}

}  // namespace
}  // namespace corpuscle::contact
