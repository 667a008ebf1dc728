// Mass and inertia from meshes, free motion of a body, distance fields, and the models of body motion.
#include "bodies/solid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bodies/bodySettings.hpp"
#include "geometry/distanceField.hpp"
#include "membrane/meshes.hpp"

using namespace corpuscle;
using namespace corpuscle::bodies;

namespace {

// A box from -half to half.
geometry::TriangleMesh cuboid(const Vec3& half) {
    geometry::TriangleMesh mesh;
    for (int n = 0; n < 8; ++n)
        mesh.nodes.push_back(half.cwiseProduct(Vec3(n & 1 ? 1 : -1, n & 2 ? 1 : -1, n & 4 ? 1 : -1)));
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

geometry::TriangleMesh sphere(double radius) {
    auto mesh = membrane::testing::icosphere(4);
    for (Vec3& x : mesh.nodes) x *= radius;
    return {mesh.nodes, mesh.triangles};
}

Mat3 someRotation() { return Eigen::AngleAxisd(0.7, Vec3(1, 2, -2).normalized()).toRotationMatrix(); }

std::shared_ptr<const BodyMotion> motion(const std::string& text) {
    Problems problems;
    auto chosen = readChoice<BodyMotion>(parseValue(text, "test", problems), problems);
    problems.throwIfAny();
    return chosen.model;
}

struct Top {
    Solid solid{cuboid(Vec3(1, 2, 3)), 1};
    RigidState state{Vec3::Zero(), solid.startOrientation(), {Vec3(0.1, 0, 0), Vec3(0.3, 1, 0.2)}};
    double energy() const { return 0.5 * state.motion.angular.dot(state.angularMomentum(solid)); }
};

// The orientation of a free top after unit time.
Eigen::Quaterniond flight(int steps) {
    Top top;
    for (int k = 0; k < steps; ++k) drift(top.state, top.solid, 1.0 / steps);
    return top.state.orientation;
}

}  // namespace

TEST(Solid, massAndInertiaOfACuboidAreExact) {
    const Vec3 half(0.5, 1, 1.5);
    geometry::TriangleMesh mesh = cuboid(half);
    const Mat3 R = someRotation();
    mesh.rotate(R);
    mesh.translate(Vec3(7, -3, 2));
    const Solid solid(mesh, 3);
    const double m = 3 * 1 * 2 * 3;
    EXPECT_NEAR(solid.mass, m, 1e-12 * m);
    // For each axis m/12 times the sum of the squares of the two edges normal to it, in ascending order.
    EXPECT_NEAR((solid.inertia - m / 12 * Vec3(1 + 4, 1 + 9, 4 + 9)).norm(), 0, 1e-11 * m);
    EXPECT_NEAR((solid.startCentre() - Vec3(7, -3, 2)).norm(), 0, 1e-13);
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
        EXPECT_NEAR((solid.startCentre() + solid.startOrientation() * solid.surface.nodes[n] - mesh.nodes[n]).norm(), 0,
                    1e-12);
    EXPECT_NEAR(solid.radius(), half.norm(), 1e-12);
}

TEST(RigidState, aFreeTopKeepsAngularMomentumAndAlmostItsEnergy) {
    Top top;
    const Vec3 L = top.state.angularMomentum(top.solid);
    const double energy = top.energy();
    double largest = 0;
    for (int k = 0; k < 2000; ++k) {
        drift(top.state, top.solid, 0.02);
        largest = std::max(largest, std::abs(top.energy() / energy - 1));
    }
    EXPECT_LT((top.state.angularMomentum(top.solid) - L).norm(), 1e-12 * L.norm());
    EXPECT_LT(largest, 1e-4) << "no drift of the energy: the scheme is symplectic";
    EXPECT_NEAR(top.state.centre[0], 4, 1e-12);
    EXPECT_NEAR(top.state.orientation.norm(), 1, 1e-15);
}

TEST(RigidState, theFlightIsOfSecondOrderAndReversible) {
    const Eigen::Quaterniond exact = flight(4096);
    const double coarse = flight(16).angularDistance(exact), fine = flight(32).angularDistance(exact);
    EXPECT_NEAR(coarse / fine, 4, 0.1);
    Top top;
    for (const double dt : {0.1, -0.1}) drift(top.state, top.solid, dt);
    EXPECT_LT(top.state.orientation.angularDistance(top.solid.startOrientation()), 1e-14);
}

// The axis of a symmetric top precesses about L at the rate L/I, where I is the moment of inertia across the axis.
TEST(RigidState, aSymmetricTopPrecesses) {
    const Solid solid(cuboid(Vec3(1, 1, 2)), 1);
    RigidState state{Vec3::Zero(), solid.startOrientation(), {Vec3::Zero(), Vec3(0.5, 0, 1)}};
    const Vec3 L = state.angularMomentum(solid);
    const double period = 2 * std::numbers::pi * solid.inertia.maxCoeff() / L.norm();
    for (int k = 0; k < 1000; ++k) drift(state, solid, period / 1000);
    const Vec3 axis = state.orientation * (solid.startOrientation().conjugate() * Vec3(0, 0, 1));
    EXPECT_NEAR((axis - Vec3(0, 0, 1)).norm(), 0, 2e-5);
}

TEST(BodyMotion, freeFollowsNewtonAndEuler) {
    const Solid solid(cuboid(Vec3(1, 1, 1)), 2);
    const auto free = motion("free");
    const Wrench wrench{Vec3(3, 0, 1), Vec3(0, 2, 0)};
    RigidState state{Vec3::Zero(), solid.startOrientation(), {}};
    for (int k = 0; k < 100; ++k) free->advance(state, solid, wrench, 0.01), free->finish(state, solid, wrench, 0.01);
    EXPECT_NEAR((state.motion.linear - wrench.force / 16).norm(), 0, 1e-13);
    EXPECT_NEAR((state.centre - 0.5 * wrench.force / 16).norm(), 0, 1e-13);
    const double I = 16.0 / 12 * 8;
    EXPECT_NEAR(state.motion.angular[1], 2 / I, 1e-13);
    EXPECT_NEAR(state.orientation.angularDistance(solid.startOrientation()), 1 / I, 1e-12);
    const RigidMotion rate = free->response(state, solid, wrench);
    EXPECT_NEAR((rate.linear - wrench.force / 16).norm() + (rate.angular - wrench.torque / I).norm(), 0, 1e-13);
    EXPECT_EQ(free->start({Vec3(1, 2, 3), Vec3(4, 5, 6)}).angular, Vec3(4, 5, 6));
    EXPECT_EQ(motion("{type: free, velocity: [0 m/s, 0 m/s, 2 m/s]}")->start({Vec3(1, 2, 3), {}}).linear,
              Vec3(0, 0, 2));
}

TEST(BodyMotion, heldAndDrivenDoNotYield) {
    const Solid solid(cuboid(Vec3(1, 2, 3)), 2);
    const Wrench wrench{Vec3(3, 0, 1), Vec3(0, 2, 0)};
    const auto held = motion("held"),
               driven =
                   motion("{type: driven, velocity: [1 m/s, 0 m/s, 0 m/s], angularVelocity: [0 1/s, 0 1/s, 2 1/s]}");
    for (const auto& model : {held, driven}) {
        RigidState state{Vec3::Zero(), solid.startOrientation(), model->start({Vec3(9, 9, 9), Vec3(9, 9, 9)})};
        EXPECT_EQ(model->response(state, solid, wrench).linear, Vec3(0, 0, 0));
        for (int k = 0; k < 10; ++k)
            model->advance(state, solid, wrench, 0.1), model->finish(state, solid, wrench, 0.1);
        const bool moves = model == driven;
        EXPECT_NEAR((state.centre - Vec3(moves ? 1 : 0, 0, 0)).norm(), 0, 1e-14);
        EXPECT_NEAR(state.orientation.angularDistance(solid.startOrientation()), moves ? 2 : 0, 1e-13);
    }
    EXPECT_DOUBLE_EQ(driven->speed(3), 1 + 2 * 3);
    EXPECT_THROW(motion("driven"), CaseError);
}

TEST(DistanceField, isThatOfTheSurfaceWithinItsReach) {
    const double radius = 5, spacing = 0.5, reach = 2;
    const geometry::DistanceField field(sphere(radius), spacing, reach);
    // The error of interpolation is spacing^2/4 (k1 + k2), that of the mesh its sagitta.
    const double tolerance = spacing * spacing / 4 * 2 / (radius - reach) + 0.02;
    for (const double r : {3.2, 4.0, 4.9, 5.0, 5.3, 6.0, 6.9})
        for (const Vec3& way : {Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(-1, 2, 3), Vec3(0.2, -1, 0.1)})
            EXPECT_NEAR(field.at(r * way.normalized()), r - radius, tolerance) << r << ' ' << way.transpose();
    EXPECT_DOUBLE_EQ(field.at(Vec3(0.1, 0, 0)), -reach);
    EXPECT_DOUBLE_EQ(field.at(Vec3(7.5, 0, 0)), reach);
    EXPECT_DOUBLE_EQ(field.at(Vec3(100, 0, 0)), reach);
}
