// Surfaces that are pressed together by forces much larger than the barrier's, in steps that are much too long: since
// freeTravel cuts the steps, the surfaces never cross.
#include <gtest/gtest.h>

#include <algorithm>

#include "contact/barrier.hpp"
#include "contact/contacts.hpp"
#include "contact/surfaces.hpp"
#include "geometry/crossings.hpp"

namespace corpuscle::contact {
namespace {

using geometry::ImagePair;

// Forces of springs along the edges, of stiffness 1.
void addElasticity(const Surface& surface, std::span<const Vec3> rest, std::span<const Vec3> x, std::span<Vec3> f) {
    for (const Edge& e : surface.edges()) {
        const Vec3 along = x[e[1]] - x[e[0]];
        const double l0 = (rest[e[1]] - rest[e[0]]).norm();
        const Vec3 force = (along.norm() - l0) / along.norm() * along;
        f[e[0]] += force, f[e[1]] -= force;
    }
}

geometry::SurfaceView view(const geometry::TriangleMesh& mesh) { return {&mesh.nodes, &mesh.triangles}; }

struct Pressing {
    Scene scene;
    std::vector<geometry::TriangleMesh> meshes;
    std::vector<Vec3> rest;
    std::vector<ImagePair> pairs;
    double push, strength, thickness;
    double least = 1;

    // Pushes both surfaces towards the plane x = 0, for `steps` steps; a node moves by `step` times its force, cut by
    // freeTravel.
    void run(int steps, double step) {
        auto law = std::make_shared<Barrier>();
        law->length = 0.04, law->strength = strength, law->thickness = thickness;
        Contacts contacts(law);
        const std::vector<const Surface*> pointers = scene.pointers();
        for (int n = 0; n < steps; ++n) {
            if (n == 0 || !contacts.covers(scene.x)) {
                contacts.find(pointers, scene.x, pairs, 0.05);
            } else {
                contacts.evaluate(scene.x);
            }
            least = std::min(least, contacts.leastGap());
            std::vector<Vec3> f(scene.x.size(), Vec3::Zero());
            contacts.addForces(f);
            for (std::size_t s = 0; s < pointers.size(); ++s) {
                const std::size_t first = contacts.firstNode(s), count = pointers[s]->nodes();
                addElasticity(*pointers[s], {rest.data() + first, count}, {scene.x.data() + first, count},
                              {f.data() + first, count});
                for (std::size_t k = first; k < first + count; ++k) f[k].x() += s == 0 ? push : -push;
            }
            for (Vec3& one : f) one *= step;
            const double free = contacts.freeTravel(scene.x, f);
            ASSERT_GE(free, 0);
            for (std::size_t k = 0; k < f.size(); ++k) scene.x[k] += free * f[k];
            if (n % 10 == 0 || n == steps - 1) check(contacts);
            if (::testing::Test::HasFailure()) return;
        }
    }

    void check(const Contacts& contacts) {
        for (std::size_t s = 0; s < meshes.size(); ++s)
            std::copy_n(scene.x.begin() + contacts.firstNode(s), meshes[s].nodes.size(), meshes[s].nodes.begin());
        EXPECT_FALSE(geometry::crossing(view(meshes[0]), view(meshes[1]), Vec3::Zero()));
        for (const geometry::TriangleMesh& mesh : meshes) EXPECT_TRUE(geometry::selfIntersections(mesh).empty());
    }
};

Pressing spheres(double push, double strength, double thickness) {
    Pressing all{{}, {sphere(1, 3), sphere(0.9, 3)}, {}, {}, push, strength, thickness};
    all.meshes[0].translate({-1.03, 0, 0});
    all.meshes[1].rotate(geometry::rotationFromZ({0.3, 0.5, 1}));
    all.meshes[1].translate({0.93, 0.1, -0.05});
    for (const geometry::TriangleMesh& mesh : all.meshes) all.scene.add(mesh);
    all.rest = all.scene.x;
    all.pairs = {{0, 1, Vec3::Zero()}, {0, 0, Vec3::Zero()}, {1, 1, Vec3::Zero()}};
    return all;
}

TEST(Pressing, spheresFlattenAndDoNotCross) {
    Pressing all = spheres(2e-3, 1e-2, 0);
    all.run(400, 0.1);
    EXPECT_LT(all.least, 0.03);
    EXPECT_GT(all.least, 0);
}

TEST(Pressing, meshesStayApartByTheThickness) {
    Pressing all = spheres(2e-3, 1e-2, 0.01);
    all.run(300, 0.1);
    EXPECT_LT(all.least, 0.03);
    EXPECT_GT(all.least, 0);
}

// With a barrier of almost no strength and violent steps, only freeTravel keeps the surfaces apart.
TEST(Pressing, violentStepsDoNotCross) {
    Pressing all = spheres(0.3, 1e-9, 0);
    all.run(150, 5);
    EXPECT_GT(all.least, 0);
    EXPECT_LT(all.least, 1e-3);
}

}  // namespace
}  // namespace corpuscle::contact
