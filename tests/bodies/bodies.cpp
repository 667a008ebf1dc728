// Rigid bodies in fluid: forces compared with a plain double loop, exact balances, periodic images and ranks.
#include "bodies/bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bodies/extrapolation.hpp"
#include "bodies/sphereInFluid.hpp"

using namespace corpuscle;
using namespace corpuscle::bodies;
using namespace corpuscle::bodies::testing;

namespace {

Vec3 someVelocity(std::size_t id, const Vec3& arm) {
    const auto n = static_cast<double>(id);
    return 0.3 * Vec3(std::sin(n), std::cos(2 * n), std::sin(3 * n)) + Vec3(0.2 * arm[2], 0, 0);
}

const RigidMotion turning{Vec3(0.1, -0.2, 0.05), Vec3(0.1, 0.3, -0.2)};

// Force and torque on the body and accelerations of the fluid, by a double loop over all particles.
struct Plain {
    Wrench wrench;
    std::vector<Vec3> acceleration;
};
Plain plainForces(SphereInFluid& f) {
    const std::size_t n = f.places.size();
    const Box box = f.system->box();
    std::vector<Vec3> arm(n), u(n), slope(n, Vec3::Zero());
    std::vector<double> density(n), depth(n, 0);
    std::vector<Vec3> foot(n, Vec3::Zero());
    std::size_t member = 0;
    for (std::size_t i = 0; i < n; ++i) {
        arm[i] = box.periodicity().shortest(f.places[i] - f.centre);
        density[i] = 1 + 0.02 * std::sin(static_cast<double>(i));
        if (f.solid[i]) {
            const BodyParticle& part = f.body().particles[member++];
            u[i] = turning.at(arm[i]), depth[i] = part.depth, foot[i] = f.body().state.orientation * part.foot;
            continue;
        }
        u[i] = someVelocity(i, arm[i]);
        const double distance = f.body().distance.at(f.body().inBody(arm[i]));
        if (distance < support)
            slope[i] = (u[i] - turning.at(arm[i])) /
                       effectiveDistance(f.body().distance, f.body().inBody(arm[i]), std::max(distance, 0.25), 1);
    }
    const auto specific = [&](std::size_t i) {
        return f.fluid.equationOfState->pressure(density[i], 1, f.fluid.soundSpeed) / (density[i] * density[i]);
    };
    Plain plain{{}, std::vector<Vec3>(n, Vec3::Zero())};
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            const Vec3 d = box.periodicity().shortest(f.places[j] - f.places[i]);
            const double q = d.norm() / support;
            if (i == j || q >= 1 || (f.solid[i] && f.solid[j])) continue;
            const double F = f.fluid.kernel->gradientNormalisation(support) * f.fluid.kernel->slope(q);
            const Vec3 du = u[j] - u[i] - depth[j] * slope[i] + depth[i] * slope[j];
            const Vec3 force =
                -(specific(i) + specific(j)) * F * d + 2 * f.fluid.viscosity / (density[i] * density[j]) * F * du;
            if (!f.solid[i]) plain.acceleration[i] += force;
            if (f.solid[i]) plain.wrench.force += force, plain.wrench.torque += foot[i].cross(force);
        }
    const Mat3 R = f.body().state.rotation();
    plain.wrench.torque -= R * f.body().rotationalDrag * R.transpose() * turning.angular;
    return plain;
}

void compare(SphereInFluid& f) {
    f.setVelocities(someVelocity, turning);
    f.bodies->moved(*f.system, 0, false);
    f.forces->evaluate(*f.system, 0);
    f.bodies->addAccelerations(*f.system);
    const Plain plain = plainForces(f);
    double size = 0, error = 0;
    const ParticleStore& s = f.system->store();
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec3 expected = plain.acceleration[static_cast<std::size_t>(s.id[i])];
        error = std::max(error, (Vec3(s.fx[i], s.fy[i], s.fz[i]) - expected).norm());
        size = std::max(size, expected.norm());
    }
    EXPECT_LT(error, 1e-11 * size);
    EXPECT_LT((f.body().wrench.force - plain.wrench.force).norm(), 1e-11 * plain.wrench.force.norm());
    EXPECT_LT((f.body().wrench.torque - plain.wrench.torque).norm(), 1e-11 * plain.wrench.torque.norm());
    EXPECT_GT(plain.wrench.torque.norm(), 1);
}

}  // namespace

TEST(Bodies, forcesAreThoseOfThePlainDoubleLoop) {
    SphereInFluid f({12, 12, 12}, Vec3(6, 6, 6), "held", 1, 0.15);
    compare(f);
}

TEST(Bodies, aBodyMayLieAcrossPeriodicFacesAndRanks) {
    SphereInFluid f({12, 12, 12}, Vec3(0.25, 11.5, 12.75), "held", 1, 0.15);
    compare(f);
}

// Fluid that moves rigidly with the body exerts neither torque nor force on it.
TEST(Bodies, fluidThatMovesWithTheBodyExertsNothing) {
    SphereInFluid f({14, 14, 14}, Vec3(7, 7, 7), "held");
    f.setVelocities([](std::size_t, const Vec3& arm) { return turning.at(arm); }, turning);
    ParticleStore& s = f.system->store();
    std::fill(s.density.begin(), s.density.end(), 1.0);
    f.bodies->moved(*f.system, 0, false);
    f.forces->evaluate(*f.system, 0);
    f.bodies->addAccelerations(*f.system);
    const double scale = (f.body().rotationalDrag * turning.angular).norm();
    EXPECT_LT(f.body().wrench.torque.norm(), 1e-12 * scale);
    EXPECT_LT(f.body().wrench.force.norm(), 1e-12 * scale);
}

// D tends to 2 mu V as the ratio of the kernel's support to the sphere's radius tends to 0; here the ratio is large.
TEST(Bodies, rotationalDragIsBelowItsContinuumLimit) {
    SphereInFluid f({14, 14, 14}, Vec3(7, 7, 7), "held");
    const Mat3 D = f.body().rotationalDrag / (2 * f.fluid.viscosity * f.body().solid.volume);
    EXPECT_NEAR((D - D(0, 0) * Mat3::Identity()).norm(), 0, 1e-3);
    EXPECT_GT(D(0, 0), 0.7);
    EXPECT_LT(D(0, 0), 1);
}

TEST(Bodies, fluidAndFreeBodyKeepTheirMomentum) {
    SphereInFluid f({12, 12, 12}, Vec3(3, 6, 9), "free", 2.5);
    f.setVelocities(someVelocity, turning);
    sph::VelocityVerlet scheme(*f.system, *f.forces, nullptr, {f.bodies.get()});
    scheme.start();
    const Body& body = f.body();
    const Vec3 before = f.momentum() + body.solid.mass * body.state.motion.linear;
    const Vec3 velocity = body.state.motion.linear;
    for (int k = 0; k < 40; ++k) scheme.advance(0.02);
    const Vec3 after = f.momentum() + body.solid.mass * body.state.motion.linear;
    EXPECT_LT((after - before).norm(), 1e-12 * body.solid.mass);
    EXPECT_GT((body.state.motion.linear - velocity).norm(), 1e-3);
    EXPECT_GT(f.system->rebuilds(), 1);
    // The body's particles follow its position and motion.
    const ParticleStore& s = f.system->store();
    for (std::size_t i = 0; i < s.size(); ++i) {
        if (s.kindOf(i) != Kind::body) continue;
        const Vec3 arm = body.state.orientation * body.particles[static_cast<std::size_t>(s.member[i])].place;
        EXPECT_LT(f.system->periodicity().shortest(body.state.centre + arm - s.position(i)).norm(), 1e-12);
        EXPECT_LT((body.state.motion.at(arm) - s.velocity(i)).norm(), 1e-12);
    }
}

TEST(Bodies, everythingMovingTogetherGoesOnForEver) {
    SphereInFluid f({12, 12, 12}, Vec3(6, 6, 6), "free", 0.5);
    const Vec3 U(0.4, -0.3, 0.2);
    f.setVelocities([&](std::size_t, const Vec3&) { return U; }, {U, Vec3::Zero()});
    ParticleStore& s = f.system->store();
    std::fill(s.density.begin(), s.density.end(), 1.0);
    sph::VelocityVerlet scheme(*f.system, *f.forces, nullptr, {f.bodies.get()});
    scheme.start();
    for (int k = 0; k < 100; ++k) scheme.advance(0.03);
    EXPECT_LT((f.body().state.centre - Vec3(6, 6, 6) - 3 * U).norm(), 1e-10);
    EXPECT_LT(f.body().turned().angularDistance(Eigen::Quaterniond::Identity()), 1e-10);
}

// A light body increases the viscous rate, by its own drag over its own mass.
TEST(Bodies, viscousRateKnowsAFreeBody) {
    const auto rate = [](const char* behaviour, double density) {
        SphereInFluid f({12, 12, 12}, Vec3(6, 6, 6), behaviour, density);
        return f.forces->viscousRate(*f.system, 40);
    };
    const double held = rate("held", 1), neutral = rate("free", 1), light = rate("free", 0.004);
    EXPECT_GT(neutral, 0.95 * held);
    EXPECT_LT(neutral, 1.3 * held);
    EXPECT_GT(light, 2 * held);
    EXPECT_NEAR(rate("free", 0.002) / light, 2, 0.1);
}

TEST(Bodies, restoredStateIsTheSame) {
    SphereInFluid f({12, 12, 12}, Vec3(6, 6, 6), "free");
    f.body().state.motion = turning;
    drift(f.body().state, f.body().solid, 0.3);
    f.body().wrench = {Vec3(1, 2, 3), Vec3(4, 5, 6)};
    SphereInFluid g({12, 12, 12}, Vec3(6, 6, 6), "free");
    g.body().restore(f.body().saved());
    EXPECT_EQ(g.body().state.centre, f.body().state.centre);
    EXPECT_EQ(g.body().state.orientation.coeffs(), f.body().state.orientation.coeffs());
    EXPECT_EQ(g.body().wrench.torque, f.body().wrench.torque);
    EXPECT_EQ(g.body().saved(), f.body().saved());
    EXPECT_THROW(g.body().restore({1, 2, 3}), Failure);
}
