#include "geometry/triangleMesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "geometry/mesher.hpp"
#include "geometry/spheroid.hpp"

using namespace corpuscle;
using namespace corpuscle::geometry;

namespace {

TriangleMesh box(const Vec3& low, const Vec3& size) {
    TriangleMesh mesh;
    for (int n = 0; n < 8; ++n) mesh.nodes.push_back(low + Vec3(n & 1, n >> 1 & 1, n >> 2).cwiseProduct(size));
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

bool mentions(const std::vector<std::string>& faults, const std::string& word) {
    for (const std::string& fault : faults)
        if (fault.find(word) != std::string::npos) return true;
    return false;
}

TEST(TriangleMesh, integralsOfABox) {
    const Vec3 size(1, 2, 3), low(5, -7, 2);
    const TriangleMesh mesh = box(low, size);
    EXPECT_NEAR(mesh.area(), 22, 1e-12);
    EXPECT_NEAR(mesh.volume(), 6, 1e-12);
    EXPECT_LT((mesh.centroid() - low - size / 2).norm(), 1e-12);
    const Mat3 inertia = mesh.inertia();
    EXPECT_NEAR(inertia(0, 0), 6.0 / 12 * (4 + 9), 1e-10);
    EXPECT_NEAR(inertia(1, 1), 6.0 / 12 * (1 + 9), 1e-10);
    EXPECT_NEAR(inertia(2, 2), 6.0 / 12 * (1 + 4), 1e-10);
    EXPECT_NEAR(inertia(0, 1), 0, 1e-10);
    EXPECT_EQ(mesh.edges().size(), 18u);
}

TEST(TriangleMesh, turningKeepsVolumeAndTurnsInertia) {
    TriangleMesh mesh = box({0, 0, 0}, {1, 2, 3});
    const Mat3 before = mesh.inertia(), turn = rotationFromZ({1, 2, -1});
    EXPECT_LT((turn * Vec3::UnitZ() - Vec3(1, 2, -1).normalized()).norm(), 1e-15);
    EXPECT_LT((rotationFromZ({0, 0, -2}) * Vec3::UnitZ() + Vec3::UnitZ()).norm(), 1e-15);
    mesh.rotate(turn, {9, 9, 9});
    mesh.translate({1, 0, 0});
    EXPECT_NEAR(mesh.volume(), 6, 1e-12);
    EXPECT_LT((mesh.inertia() - turn * before * turn.transpose()).norm(), 1e-10);
}

TEST(TriangleMesh, vertexAreasAddUpAndNormalsPointOut) {
    const Sphere sphere(1e-6);
    const TriangleMesh mesh = meshSurface(sphere, 0.15e-6);
    const auto areas = mesh.vertexAreas();
    EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0) / mesh.area(), 1, 1e-13);
    const auto normals = mesh.vertexNormals();
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) EXPECT_GT(normals[n].dot(mesh.nodes[n].normalized()), 0.999);
}

TEST(TriangleMesh, edgesKnowTheirTriangles) {
    const TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
    for (const MeshEdge& e : mesh.edges()) {
        ASSERT_GE(e.left, 0);
        ASSERT_GE(e.right, 0);
        const Index3& t = mesh.triangles[e.left];
        EXPECT_TRUE((t[0] == e.a && t[1] == e.b) || (t[1] == e.a && t[2] == e.b) || (t[2] == e.a && t[0] == e.b));
    }
}

TEST(CheckClosedManifold, soundMeshHasNoFaults) { EXPECT_TRUE(checkClosedManifold(box({0, 0, 0}, {1, 1, 1})).empty()); }

TEST(CheckClosedManifold, namesEachFault) {
    const TriangleMesh sound = box({0, 0, 0}, {1, 1, 1});
    TriangleMesh mesh = sound;
    mesh.triangles.pop_back();
    EXPECT_TRUE(mentions(checkClosedManifold(mesh), "open edges"));

    mesh = sound;
    mesh.triangles.push_back(mesh.triangles.front());
    EXPECT_TRUE(mentions(checkClosedManifold(mesh), "non-manifold"));

    mesh = sound;
    std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
    EXPECT_TRUE(mentions(checkClosedManifold(mesh), "opposite orientation"));

    mesh = sound;
    mesh.flip();
    EXPECT_TRUE(mentions(checkClosedManifold(mesh), "inwards"));

    mesh = sound;
    mesh.nodes[1] = mesh.nodes[0];
    EXPECT_TRUE(mentions(checkClosedManifold(mesh), "degenerate"));

    mesh = sound;
    mesh.triangles[0][1] = 99;
    EXPECT_TRUE(mentions(checkClosedManifold(mesh), "does not exist"));

    mesh = sound;
    mesh.nodes.push_back({3, 3, 3});
    EXPECT_TRUE(mentions(checkClosedManifold(mesh), "belong to no triangle"));

    mesh = sound;
    mesh.nodes[7] = Vec3(-0.5, -0.5, -0.5);  // the far corner is pulled through the opposite one
    EXPECT_TRUE(mentions(checkClosedManifold(mesh), "cut each other"));
}

TEST(CheckClosedManifold, severalSurfacesAndPinchedNodes) {
    TriangleMesh two = box({0, 0, 0}, {1, 1, 1});
    const TriangleMesh other = box({3, 0, 0}, {1, 1, 1});
    for (const Vec3& x : other.nodes) two.nodes.push_back(x);
    for (const auto& [i, j, k] : other.triangles) two.triangles.push_back({i + 8, j + 8, k + 8});
    EXPECT_TRUE(mentions(checkClosedManifold(two), "2 separate surfaces"));

    // Two boxes that share one corner only.
    TriangleMesh pinched = box({0, 0, 0}, {1, 1, 1});
    const TriangleMesh touching = box({1, 1, 1}, {1, 1, 1});
    for (int n = 1; n < 8; ++n) pinched.nodes.push_back(touching.nodes[n]);
    const auto number = [](int n) { return n == 0 ? 7 : n + 7; };
    for (const auto& [i, j, k] : touching.triangles) pinched.triangles.push_back({number(i), number(j), number(k)});
    EXPECT_TRUE(mentions(checkClosedManifold(pinched), "touches itself"));
}

}  // namespace
