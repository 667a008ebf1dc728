// Drag and torque on a sphere in a periodic box, computed by the implicit step, against Stokes flow.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "implicit/rigidSphereScene.hpp"

using namespace corpuscle;
using namespace corpuscle::implicit;
using bodies::testing::SphereInFluid;
using implicit::testing::RigidSphereScene;

namespace {

constexpr double pi = std::numbers::pi, tolerance = 1e-4;
constexpr int steps = 40;

double fraction(double radius, int length) { return 4 * pi / 3 * std::pow(radius / length, 3); }

double hasimoto(double c) { return 1 / (1 - 1.7601 * std::cbrt(c) + c - 1.5593 * c * c); }

void run(RigidSphereScene& s, double time) {
    const auto step = s.step(tolerance);
    for (int k = 0; k < steps; ++k) step->advance(time / steps);
    std::printf("%.1f iterations a step\n", static_cast<double>(step->statistics.iterations) / steps);
}

RigidSphereScene sphereInCube(double radius, int length, const std::string& behaviour, double tolerance,
                              const Vec3& bodyForce = Vec3::Zero()) {
    const Vec3 middle = Vec3::Constant(0.5 * length);
    SphereInFluid sphere({length, length, length}, middle, behaviour, 1, 0, radius, bodyForce, MPI_COMM_WORLD,
                         bodies::Bodies::Medium::unlimited);
    return {std::move(sphere), tolerance};
}

// tests/bodies/drag.cpp has the same test of the explicit step. The force is so small that particles hardly move, so no
// shifting is needed. expected: estimate of K, which sets the time to steady flow. ofMesh: radius of the sphere on
// which the nodes of the mesh lie.
double dragFactor(double radius, int length, double expected, double ofMesh) {
    RigidSphereScene s = sphereInCube(ofMesh, length, "held", 1e-3, Vec3(1e-5, 0, 0));
    const double drag = 6 * pi * s.scene.model().viscosity * radius, volume = std::pow(length, 3);
    run(s, 3.5 * volume / (drag * expected));
    return s.body().wrench.force[0] / (drag * s.fluidMomentum()[0] / volume);
}

double torqueFactor(double radius, int length) {
    RigidSphereScene s =
        sphereInCube(radius, length, "{type: driven, angularVelocity: [0 1/s, 0.002 1/s, 0 1/s]}", 2e-3);
    s.body().state.motion.angular = Vec3(0, 0.002, 0);
    run(s, 0.1 * length * length / s.scene.model().viscosity);
    return -s.body().wrench.torque[1] / (8 * pi * s.scene.model().viscosity * std::pow(radius, 3) * 0.002);
}

}  // namespace

// Hasimoto, J. Fluid Mech. 5:317 (1959): 1/K = 1 - 1.7601 c^(1/3) + c - 1.5593 c^2, c the volume fraction.
TEST(BodyDrag, ofACubicArrayIsHasimotos) {
    for (const auto& [radius, length, allowed] : {std::tuple{3.0, 15, 0.01}, std::tuple{4.5, 23, 0.01}}) {
        const double K = hasimoto(fraction(radius, length)), measured = dragFactor(radius, length, K, radius);
        std::printf("a = %.1f dx: K %.4f, Hasimoto %.4f, %+.2f %%\n", radius, measured, K, 100 * (measured / K - 1));
        EXPECT_NEAR(measured / K, 1, allowed);
    }
}

// Zick and Homsy, J. Fluid Mech. 115:13 (1982). The gap between spheres is 0.8 dx. The mesh encloses the volume of the
// sphere; the particles in it have 0.7 % more volume. With the linear continuation across gaps alone, K would be too
// small by some per cent.
TEST(BodyDrag, ofADenseArrayIsZickAndHomsys) {
    constexpr double c = 0.45, K = 28.1;
    constexpr int length = 16;
    const double radius = std::cbrt(3 * c / (4 * pi)) * length,
                 measured = dragFactor(radius, length, 0.08 * K, 1.0024 * radius);
    std::printf("a = %.1f dx: K %.2f, Zick and Homsy %.2f, %+.2f %%\n", radius, measured, K, 100 * (measured / K - 1));
    EXPECT_NEAR(measured / K, 1, 0.025);
}

// The periodic images turn the fluid backwards: T = 8 pi mu a^3 Omega/(1 - c).
TEST(BodyDrag, torqueOnATurningSphereIsStokes) {
    for (const auto& [radius, length, allowed] : {std::tuple{3.0, 15, 0.02}, std::tuple{4.5, 22, 0.01}}) {
        const double measured = torqueFactor(radius, length) * (1 - fraction(radius, length));
        std::printf("a = %.1f dx: T (1 - c)/(8 pi mu a^3 Omega) %.4f\n", radius, measured);
        EXPECT_NEAR(measured, 1, allowed);
    }
}
