// Rigid bodies in the implicit step: symmetry of system and preconditioner, conservation of momentum, steps taken back,
// limits of the step, independence of the number of ranks.
#include "implicit/preconditioner.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "implicit/rigidSphereScene.hpp"

using namespace corpuscle;
using namespace corpuscle::implicit;
using bodies::RigidMotion;
using bodies::testing::SphereInFluid;
using implicit::testing::RigidSphereScene;

namespace {

const RigidMotion turning{Vec3(0.01, -0.02, 0.005), Vec3(0.01, 0.03, -0.02)};

Vec3 someVelocity(std::size_t id, const Vec3& arm) {
    const auto n = static_cast<double>(id);
    return 0.01 * Vec3(std::sin(n), std::cos(2 * n), std::sin(3 * n)) + Vec3(0.01 * arm[2], 0, 0);
}

// The system of a first step of 2/3 s, where c1 = 3 and pressure is extrapolated by a third of a second, and its
// preconditioner.
struct SphereSystem {
    using Field = System<double>::Field;
    RigidSphereScene sphere;
    ImplicitSettings settings;
    System<double> system;
    std::unique_ptr<Preconditioner<double>> preconditioner;

    explicit SphereSystem(const char* behaviour, double disorder = 0.15, const std::string& name = "twoLevel",
                          int length = 12)
        : sphere(SphereInFluid({length, length, length}, Vec3(3, 6, 11), behaviour, 2.5, disorder), 1),
          system(sphere.scene, {}, settings, nullptr, nullptr, isOnGrid(name)),
          preconditioner(makePreconditioner(name, system)) {
        system.prepare(TimeDifference::midpoint(2.0 / 3, {}, false));
        preconditioner->prepare();
    }
    RigidUnknowns<double>& rigid() { return *system.rigid(); }
    std::size_t size() const { return sphere.scene.store().size(); }

    // An allowed velocity, from random numbers that do not depend on the number of ranks.
    Field velocity(unsigned seed, const RigidMotion& motion) {
        sphere.body().state.motion = motion, sphere.body().acceleration = {};
        Field u(system.length(), 0.0);
        for (std::size_t i = 0; i < size(); ++i) {
            std::mt19937_64 random(seed + static_cast<unsigned>(sphere.scene.store().id[i]));
            std::uniform_real_distribution<double> d(-0.1, 0.1);
            particles::setVector(u, i, Vec3(d(random), d(random), d(random)));
        }
        rigid().extrapolate(1, u);
        system.shared().distribute(u.data(), 4);
        return u;
    }
    Field times(const Field& u) {
        Field w(u.size(), 0.0);
        system.product(u, w);
        return w;
    }
    Field precondition(const Field& r) {
        Field z(r.size(), 0.0);
        preconditioner->apply(r, z);
        return z;
    }
    double dot(const Field& a, const Field& b) const {
        double sum = 0;
        system.copies().forCounted(a.size(), [&](std::size_t k) { sum += a[k] * b[k]; });
        return Communicator(sphere.scene.system->comm()).sum(sum);
    }
    // Force and torque that resist the velocity u of fluid and body: the body's rows of A u, without inertia.
    sph::Wrench resistance(const RigidMotion& motion, const Field& u) {
        const Field w = times(u);
        std::vector<double> row(w.end() - 8, w.end());
        row = Communicator(sphere.scene.system->comm()).sum(row);
        const bodies::Body& body = sphere.body();
        const double c1 = system.time().c1;
        return {Vec3::Map(row.data()) - c1 * body.solid.mass * motion.linear,
                Vec3::Map(row.data() + 4) - c1 * body.solid.inertia[0] * motion.angular};
    }
};

void run(ImplicitStep& step, double time, int steps) {
    for (int k = 0; k < steps; ++k) step.advance(time / steps);
}

}  // namespace

TEST(RigidBodies, systemAndPreconditionerAreSymmetric) {
    for (const char* name : {"twoLevel", "blockJacobi"}) {
        SphereSystem s("free", 0.15, name);
        const auto a = s.velocity(1, turning), b = s.velocity(7, {Vec3(-0.3, 0.1, 0.2), Vec3(0.2, -0.1, 0.1)});
        const auto Aa = s.times(a), Ab = s.times(b);
        const double size = std::sqrt(s.dot(a, Aa) * s.dot(b, Ab));
        EXPECT_GT(s.dot(a, Aa), 0);
        EXPECT_NEAR(s.dot(a, Ab), s.dot(b, Aa), 1e-12 * size);
        const auto za = s.precondition(Aa), zb = s.precondition(Ab);
        EXPECT_GT(s.dot(Aa, za), 0);
        EXPECT_NEAR(s.dot(Aa, zb), s.dot(Ab, za), 1e-12 * std::sqrt(s.dot(Aa, za) * s.dot(Ab, zb))) << name;
    }
}

TEST(RigidBodies, bodiesThatDoNotYieldAreTakenOut) {
    SphereSystem s("held");
    const auto u = s.velocity(1, {}), w = s.times(u), z = s.precondition(w);
    for (std::size_t i = 0; i < s.size(); ++i) {
        if (!s.rigid().isMember(i)) continue;
        for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(z[4 * i + k], 0);
    }
    for (std::size_t k = 4 * s.system.entries(); k < w.size(); ++k) EXPECT_EQ(w[k], 0);
}

// The torque D Omega is that of the pairs within the body (implicit/rigidUnknowns.hpp): on a lattice, fluid that turns
// with the body exerts neither force nor torque.
TEST(RigidBodies, fluidThatTurnsWithTheBodyExertsNothing) {
    SphereSystem s("free", 0, "twoLevel", 18);  // the seam of the periodic velocity is far from the body
    const RigidMotion spin{Vec3::Zero(), turning.angular};
    auto u = s.velocity(1, turning);
    const auto& store = s.sphere.scene.store();
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec3 arm = s.sphere.scene.system->periodicity().shortest(store.position(i) - s.sphere.centre);
        particles::setVector(u, i, turning.at(arm));
    }
    s.system.shared().distribute(u.data(), 4);
    const sph::Wrench together = s.resistance(turning, u);
    const double torque = s.resistance(spin, s.velocity(1, spin)).torque.norm();  // in fluid at rest
    EXPECT_GT(torque, 0.1);
    EXPECT_LT(together.torque.norm(), 1e-11 * torque);
    EXPECT_LT(together.force.norm(), 1e-11 * torque);
}

TEST(RigidBodies, aStepTakenBackLeavesThemAsTheyWere) {
    SphereSystem s("free");
    s.sphere.body().state.motion = turning;
    const bodies::RigidState before = s.sphere.body().state;
    s.rigid().depart(2);
    EXPECT_GT((s.sphere.body().state.centre - before.centre).norm(), 0.01);
    s.rigid().takeBack();
    EXPECT_EQ(s.sphere.body().state.centre, before.centre);
    EXPECT_EQ(s.sphere.body().state.orientation.coeffs(), before.orientation.coeffs());
}

// Particles have changed their order and their ranks since the bodies' lists of particles were made.
TEST(RigidBodies, aStepTakenBackAfterNewListsMovesBodiesAlone) {
    SphereSystem s("free");
    s.sphere.body().state.motion = turning;
    s.rigid().depart(2);
    particles::ParticleStore& store = s.sphere.scene.store();
    for (std::size_t i = 0; i < store.size(); ++i)
        if (store.kindOf(i) == particles::Kind::fluid) store.setPosition(i, store.position(i) + Vec3(2.5, -1.5, 4));
    s.sphere.scene.system->rebuild();
    std::vector<Vec3> before;
    for (std::size_t i = 0; i < store.size(); ++i) before.push_back(store.position(i));
    s.rigid().takeBack();
    const bodies::Body& body = s.sphere.body();
    for (std::size_t i = 0; i < store.size(); ++i) {
        if (store.kindOf(i) == particles::Kind::fluid) {
            EXPECT_EQ(store.position(i), before[i]);
            continue;
        }
        const Vec3 place = body.particles[static_cast<std::size_t>(store.member[i])].place,
                   off = store.position(i) - body.state.centre - body.state.orientation * place;
        EXPECT_LT(s.sphere.scene.system->periodicity().shortest(off).norm(), 1e-12);
    }
}

TEST(RigidBodies, fluidAndFreeBodyKeepTheirMomentum) {
    for (const char* method : {"midpoint", "backwardEuler"}) {
        SphereInFluid f({12, 12, 12}, Vec3(3, 6, 9), "free", 2.5, 0.1);
        f.setVelocities(someVelocity, turning);
        RigidSphereScene s(std::move(f), 0.02);
        const auto momentum = [&] {
            return Vec3(s.fluidMomentum() + s.body().solid.mass * s.body().state.motion.linear);
        };
        const Vec3 before = momentum(), velocity = s.body().state.motion.linear;
        const auto step = s.step(1e-9, method);
        Vec3 last = before, lastVelocity = velocity;
        for (int k = 0; k < 6; ++k) {
            last = momentum(), lastVelocity = s.body().state.motion.linear;
            step->advance(1);
        }
        EXPECT_LT((momentum() - before).norm(), 1e-8 * s.body().solid.mass);
        EXPECT_GT((s.body().state.motion.linear - velocity).norm(), 1e-3);
        if (std::string(method) == "backwardEuler") {  // the force is what changes momentum
            EXPECT_LT(
                (s.body().solid.mass * (s.body().state.motion.linear - lastVelocity) - s.body().wrench.force).norm(),
                1e-8 * s.body().solid.mass);
        }
        // The body's particles are at their places in the body.
        const auto& store = s.scene.store();
        for (std::size_t i = 0; i < store.size(); ++i) {
            if (store.kindOf(i) != particles::Kind::body) continue;
            const Vec3 arm =
                s.body().state.orientation * s.body().particles[static_cast<std::size_t>(store.member[i])].place;
            EXPECT_LT(s.scene.system->periodicity().shortest(s.body().state.centre + arm - store.position(i)).norm(),
                      1e-12);
        }
    }
}

TEST(RigidBodies, everythingMovingTogetherGoesOnForEver) {
    const Vec3 U(0.4, -0.3, 0.2);
    SphereInFluid f({12, 12, 12}, Vec3(6, 6, 6), "free", 0.5);
    f.setVelocities([&](std::size_t, const Vec3&) { return U; }, {U, Vec3::Zero()});
    std::fill(f.system->store().density.begin(), f.system->store().density.end(), 1.0);
    RigidSphereScene s(std::move(f), 0.02);
    run(*s.step(1e-9), 6, 6);
    EXPECT_LT((s.body().state.centre - Vec3(6, 6, 6) - 6 * U).norm(), 1e-9);
    EXPECT_LT(s.body().turned().angularDistance(Eigen::Quaterniond::Identity()), 1e-9);
}

TEST(RigidBodies, aDrivenBodyKeepsItsRates) {
    SphereInFluid f({12, 12, 12}, Vec3(6, 6, 6),
                    "{type: driven, velocity: [0.02 m/s, 0 m/s, 0 m/s], angularVelocity: [0 1/s, 0.05 1/s, 0 1/s]}");
    const RigidMotion driven{Vec3(0.02, 0, 0), Vec3(0, 0.05, 0)};
    f.setVelocities([](std::size_t, const Vec3&) { return Vec3(Vec3::Zero()); }, driven);
    RigidSphereScene s(std::move(f), 0.02);
    run(*s.step(1e-6), 8, 8);
    EXPECT_LT((s.body().state.centre - Vec3(6.16, 6, 6)).norm(), 1e-12);
    EXPECT_NEAR(s.body().turned().angularDistance(Eigen::Quaterniond::Identity()), 0.4, 1e-12);
    EXPECT_LT(s.body().wrench.force[0], -0.1);
    EXPECT_LT(s.body().wrench.torque[1], -0.1);
    EXPECT_GT(s.fluidMomentum()[0], 0.1);
}

namespace {
// The step that `error` allows after steps of dt, for a sphere of this behaviour and velocity in fluid of another
// velocity.
double allowedStep(const char* behaviour, double sphereVelocity, double fluidVelocity, double error, double dt) {
    SphereInFluid f({12, 12, 12}, Vec3(6, 6, 6), behaviour, 2.5);
    f.setVelocities([&](std::size_t, const Vec3&) { return Vec3(fluidVelocity, 0, 0); },
                    {Vec3(sphereVelocity, 0, 0), Vec3::Zero()});
    RigidSphereScene s(std::move(f), 0.02);
    const auto step = s.step(1e-9, "midpoint", sph::OperatorForm::corrected, error);
    const double time = 4;
    run(*step, time, static_cast<int>(std::lround(time / dt)));
    return step->allowed().error;
}
}  // namespace

// A sphere that the fluid slows down. The allowed step must not depend on the step from which it was estimated: the
// error is of second order.
TEST(RigidBodies, stepOfABodyIsAsLongAsItsErrorAllows) {
    const double fine = allowedStep("free", 0.02, 0, 1e-4, 0.2);
    EXPECT_NEAR(allowedStep("free", 0.02, 0, 1e-4, 0.4), fine, 0.35 * fine);
    EXPECT_GT(fine, 0.2);
    EXPECT_LT(fine, 0.4);
}

// Where no body is free, the fluid's error limits the step: here the fluid comes to rest around a sphere that is held.
TEST(RigidBodies, stepBesideAHeldBodyIsAsLongAsTheFluidsErrorAllows) {
    const double fine = allowedStep("held", 0, 0.02, 3e-5, 0.2);
    EXPECT_NEAR(allowedStep("held", 0, 0.02, 3e-5, 0.4), fine, 0.3 * fine);
    EXPECT_LT(fine, 0.39);
}

TEST(RigidBodies, areTheSameOnOneRankAndOnAll) {
    const auto make = [](MPI_Comm comm) {
        SphereInFluid f({12, 12, 12}, Vec3(0.3, 11.5, 6), "free", 2.5, 0.1, 3, Vec3(1e-3, 0, 0), comm);
        f.setVelocities(someVelocity, turning);
        return RigidSphereScene(std::move(f), 0.02);
    };
    RigidSphereScene alone = make(MPI_COMM_SELF), shared = make(MPI_COMM_WORLD);
    run(*alone.step(1e-8), 4, 4), run(*shared.step(1e-8), 4, 4);
    const bodies::RigidState &a = alone.body().state, &b = shared.body().state;
    EXPECT_LT((a.motion.linear - b.motion.linear).norm(), 1e-7 * a.motion.linear.norm());
    EXPECT_LT((a.motion.angular - b.motion.angular).norm(), 1e-6 * a.motion.angular.norm());
    EXPECT_LT((alone.body().wrench.torque - shared.body().wrench.torque).norm(),
              1e-5 * alone.body().wrench.torque.norm());
}
