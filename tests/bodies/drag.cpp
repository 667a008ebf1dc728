// Drag and torque on a sphere in a periodic box, compared with Stokes flow.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bodies/sphereInFluid.hpp"

using namespace corpuscle;
using namespace corpuscle::bodies;
using namespace corpuscle::bodies::testing;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double step = 0.08;

double fraction(double radius, int length) { return 4 * pi / 3 * std::pow(radius / length, 3); }

// Velocity averaged over the volume of the periodic box, where the sphere counts with its own velocity, 0.
double superficialVelocity(const SphereInFluid& f) { return f.momentum()[0] / std::pow(f.size[0], 3); }

double hasimoto(double c) { return 1 / (1 - 1.7601 * std::cbrt(c) + c - 1.5593 * c * c); }

// Fluid driven through a cubic array of held spheres: drag factor K = F/(6 pi mu a U), after 3.5 relaxation times, when
// force and velocity approach their final values together.
double dragFactor(double radius, int length) {
    SphereInFluid f({length, length, length}, Vec3::Constant(0.5 * length), "held", 1, 0, radius, Vec3(2e-4, 0, 0));
    sph::VelocityVerlet scheme(*f.system, *f.forces, nullptr, {f.bodies.get()});
    scheme.start();
    const double drag = 6 * pi * f.fluid.viscosity * radius, volume = std::pow(length, 3);
    const double time = 3.5 * volume / (drag * hasimoto(fraction(radius, length)));
    for (int k = 0; k * step < time; ++k) scheme.advance(step);
    return f.body().wrench.force[0] / (drag * superficialVelocity(f));
}

// Torque on a sphere that turns at a constant rate, divided by 8 pi mu a^3 Omega.
double torqueFactor(double radius, int length) {
    SphereInFluid f({length, length, length}, Vec3::Constant(0.5 * length),
                    "{type: driven, angularVelocity: [0 1/s, 0.002 1/s, 0 1/s]}", 1, 0, radius);
    f.body().state.motion.angular = Vec3(0, 0.002, 0);
    sph::VelocityVerlet scheme(*f.system, *f.forces, nullptr, {f.bodies.get()});
    scheme.start();
    const double time = 0.1 * length * length / f.fluid.viscosity;
    for (int k = 0; k * step < time; ++k) scheme.advance(step);
    return -f.body().wrench.torque[1] / (8 * pi * f.fluid.viscosity * std::pow(radius, 3) * 0.002);
}

}  // namespace

// Hasimoto, J. Fluid Mech. 5:317 (1959): 1/K = 1 - 1.7601 c^(1/3) + c - 1.5593 c^2, c the volume fraction.
TEST(Drag, ofACubicArrayIsHasimotos) {
    for (const auto& [radius, length, tolerance] : {std::tuple{3.0, 15, 0.08}, std::tuple{4.5, 22, 0.02}}) {
        const double K = hasimoto(fraction(radius, length));
        const double measured = dragFactor(radius, length);
        std::printf("a = %.1f dx: K %.4f, Hasimoto %.4f, %+.2f %%\n", radius, measured, K, 100 * (measured / K - 1));
        EXPECT_NEAR(measured / K, 1, tolerance);
    }
}

// In a periodic box the images rotate the fluid around the sphere backwards at the rate (T/8 pi mu) (4 pi/3)/L^3, so
// that T = 8 pi mu a^3 Omega/(1 - c).
TEST(Drag, torqueOnATurningSphereIsStokes) {
    double error[2];
    for (const int fine : {0, 1}) {
        const double radius = fine ? 4.5 : 3.0;
        const int length = fine ? 22 : 15;
        const double measured = torqueFactor(radius, length) * (1 - fraction(radius, length));
        std::printf("a = %.1f dx: T (1 - c)/(8 pi mu a^3 Omega) %.4f\n", radius, measured);
        error[fine] = std::abs(measured - 1);
    }
    EXPECT_LT(error[1], 0.055);
    EXPECT_GT(error[0] / error[1], std::pow(1.5, 1.8)) << "of second order in the spacing";
}
