// The parts of the implicit step, each alone: time difference, preconditioners, movement of particles, and quantities
// that the solver updates along with the velocity. Lengths in spacings, density 1.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "core/communicator.hpp"
#include "coupling/fluidScene.hpp"
#include "implicit/disturbance.hpp"
#include "implicit/movement.hpp"
#include "implicit/preconditioner.hpp"

using namespace corpuscle;
using namespace corpuscle::implicit;
using particles::setVector;
using particles::vectorAt;

namespace {

// A velocity of second degree in time, for which the midpoint formula is exact (implicit/timeDifference.hpp).
double velocityAt(double t) { return 2 + 3 * t - 0.7 * t * t; }

struct Fluid : coupling::testing::FluidScene {
    ImplicitSettings settings;
    System<double> system{scene, {}, settings, nullptr, nullptr, true};
    static constexpr double dt = 0.4;

    explicit Fluid(double viscosity = 1)
        : FluidScene(coupling::testing::still({10, 10, 12}, 0.15), {10, 10, 12}, fluid(viscosity), 1, 0, MPI_COMM_WORLD,
                     corpuscle::particles::Precision::full) {
        scene.flow.velocity = [](const Vec3&) { return Vec3(Vec3::Zero()); };
    }
    static sph::FluidModel fluid(double viscosity) {
        sph::FluidModel model = sph::testing::model("wendlandC2", "linear");
        model.viscosity = viscosity;
        return model;
    }
    void prepare() {
        scene.system->rebuild();
        system.prepare(TimeDifference::midpoint(dt, {}, false));
    }
    System<double>::Field some(unsigned seed) {
        System<double>::Field v(system.length(), 0.0);
        for (std::size_t i = 0; i < system.owned(); ++i) {
            std::mt19937_64 random(seed + 7919 * static_cast<unsigned>(scene.store().id[i]));
            std::uniform_real_distribution<double> d(-1, 1);
            setVector(v, i, Vec3(d(random), d(random), d(random)));
        }
        system.shared().distribute(v.data(), 4);
        return v;
    }
    double dot(const System<double>::Field& a, const System<double>::Field& b) {
        double sum = 0;
        system.copies().forCounted(a.size(), [&](std::size_t k) { sum += a[k] * b[k]; });
        return Communicator(scene.system->comm()).sum(sum);
    }
    long iterations(const std::string& name) {
        const auto preconditioner = makePreconditioner(name, system);
        preconditioner->prepare();
        System<double>::Field residual = some(3), x;
        ConjugateGradients<double> solver;
        const Convergence c = solver.solve(
            scene.system->comm(), residual, x, 0, 1e-6, [&](const auto& z, auto& w) { system.product(z, w); },
            [&](const auto& r, auto& z) { preconditioner->apply(r, z); }, system.copies());
        EXPECT_TRUE(c.reached) << name;
        return c.iterations;
    }
};

}  // namespace

// Steps of unequal length; velocities are known at their middles.
TEST(TimeDifference, isExactForWhatItShouldBe) {
    StepState last;
    double t = 0, middle = 0, a = 3;  // a: acceleration between the last two middles; any value at first
    for (const double dt : {0.3, 0.5, 0.2, 0.4}) {
        const TimeDifference d = TimeDifference::midpoint(dt, last, true);
        const double now = t + 0.5 * dt, v = velocityAt(now), u = velocityAt(middle);
        EXPECT_NEAR(d.h, now - middle, 1e-15);
        EXPECT_NEAR(d.reach.total(), 0.5 * dt + 0.02 * dt, 1e-15);
        if (last.lastSpacing > 0) {
            EXPECT_NEAR(d.c1 * (v - u) - d.c2 * a, 3 - 1.4 * now, 1e-13) << dt;
        }
        a = (v - u) / d.h;
        last = {t + dt - now, d.h, 0, last.steps + 1};
        t += dt, middle = now;
    }
    const TimeDifference end = TimeDifference::backwardEuler(0.25, last);
    EXPECT_TRUE(end.isAtEnd());
    EXPECT_NEAR(end.h, 0.25 + last.behind, 1e-15);
    EXPECT_NEAR(end.c1 * end.h, 1, 1e-15);
    EXPECT_EQ(end.c2, 0);
    EXPECT_EQ(end.reach.lead, 0);
}

// Conservation of mass, d(ln rho)/dt = -div v: of second order with the midpoint rule; a step forward and back restores
// the density up to rounding.
TEST(TimeDifference, density) {
    const auto error = [](bool atEnd, double dt) {
        const TimeDifference d =
            atEnd ? TimeDifference::backwardEuler(dt, {}) : TimeDifference::midpoint(dt, {}, false);
        return std::abs(d.density(2, 0.3) - 2 * std::exp(-0.3 * dt));
    };
    EXPECT_NEAR(error(false, 0.02) / error(false, 0.01), 8, 0.05);
    EXPECT_NEAR(error(true, 0.02) / error(true, 0.01), 4, 0.05);
    const TimeDifference d = TimeDifference::midpoint(0.2, {}, false);
    EXPECT_NEAR(d.density(d.density(2, 0.3), -0.3), 2, 1e-15);
}

TEST(Preconditioners, areSymmetricAndPositive) {
    Fluid f;
    f.prepare();
    const auto a = f.some(1), b = f.some(2);
    for (const char* name : {"blockJacobi", "twoLevel", "withMembrane", "automatic"}) {
        const auto preconditioner = makePreconditioner(name, f.system);
        preconditioner->prepare();
        System<double>::Field za(a.size(), 0.0), zb(b.size(), 0.0);
        preconditioner->apply(a, za), preconditioner->apply(b, zb);
        EXPECT_GT(f.dot(a, za), 0) << name;
        EXPECT_NEAR(f.dot(a, zb), f.dot(b, za), 1e-12 * std::sqrt(f.dot(a, za) * f.dot(b, zb))) << name;
        EXPECT_GT(std::abs(f.dot(a, zb)), 1e-6 * f.dot(a, za)) << "a sum that vanishes shows nothing";
    }
    EXPECT_THROW(makePreconditioner("multigrid", f.system), std::invalid_argument);
}

// In a viscous fluid the grid corrects smooth errors, which the diagonal does not; without cells the other
// preconditioners are the same as twoLevel.
TEST(Preconditioners, theGridSavesIterations) {
    Fluid f(100);
    f.prepare();
    const long diagonal = f.iterations("blockJacobi"), grid = f.iterations("twoLevel");
    EXPECT_LT(2 * grid, diagonal);
    EXPECT_EQ(f.iterations("withMembrane"), grid);
    EXPECT_EQ(f.iterations("automatic"), grid);
}

TEST(Movement, goesThereAndBackAndArrives) {
    Fluid f;
    coupling::Scene& scene = f.scene;
    Movement<double> movement(f.system, std::nullopt, nullptr);
    const auto places = [&] {
        std::map<std::int64_t, Vec3> at;
        for (std::size_t i = 0; i < scene.store().size(); ++i) at[scene.store().id[i]] = scene.store().position(i);
        return at;
    };
    const auto distance = [&](const Vec3& a, const Vec3& b) {
        return scene.system->periodicity().shortest(a - b).norm();
    };
    const Vec3 u(0.3, -0.2, 0.1), v(0.5, 0.1, -0.4);
    for (std::size_t i = 0; i < scene.store().size(); ++i) {
        scene.store().setVelocity(i, u);
        scene.store().fx[i] = scene.store().fy[i] = scene.store().fz[i] = 0;
    }
    const auto before = places();
    const TimeDifference time = TimeDifference::midpoint(Fluid::dt, {}, false);
    movement.depart(time);
    movement.takeBack(time);
    for (const auto& [id, x] : places())  // particles that are still on this rank
        if (const auto was = before.find(id); was != before.end()) {
            EXPECT_LT(distance(x, was->second), 1e-14);
        }
    movement.depart(time);
    f.system.prepare(time);
    System<double>::Field velocity(f.system.length(), 0.0);
    for (std::size_t i = 0; i < f.system.owned(); ++i) setVector(velocity, i, v);
    movement.arrive(velocity);
    for (const auto& [id, x] : places())
        if (const auto was = before.find(id); was != before.end()) {
            EXPECT_LT(distance(x, was->second + Fluid::dt * v), 1e-13);
        }
    for (std::size_t i = 0; i < scene.store().size(); ++i) {
        EXPECT_EQ(scene.store().velocity(i), v);
        EXPECT_NEAR(scene.store().fx[i], (v - u)[0] / time.h, 1e-14);
    }
    movement.moveVelocities(0.1);
    for (std::size_t i = 0; i < scene.store().size(); ++i)
        EXPECT_LT((scene.store().velocity(i) - (v + 0.1 * (v - u) / time.h)).norm(), 1e-14);
}

// w.A w (implicit/disturbance.hpp) with A applied separately, for a disturbed fluid at rest: then w = v, and b - A
// affine is M (c1 u + c2 a), which equals A v for v = A^-1 b.
TEST(Disturbance, isTheEnergyOfTheSystem) {
    Fluid f;
    coupling::Scene& scene = f.scene;
    std::mt19937_64 random(5);
    for (std::size_t i = 0; i < scene.store().size(); ++i) {
        const Vec3 x = scene.store().position(i);
        scene.store().setVelocity(i, Vec3(std::sin(x[1]), 0.3 * std::cos(x[2]), std::sin(x[0])));
        scene.store().density[i] = 1;  // no pressure
        scene.store().fx[i] = scene.store().fy[i] = scene.store().fz[i] = 0;
    }
    f.prepare();
    System<double>::Field v, residual, x;
    f.system.findGuess(v), f.system.findResidual(v, residual);
    f.system.shared().distribute(residual.data(), 4);
    const auto preconditioner = makePreconditioner("twoLevel", f.system);
    preconditioner->prepare();
    ConjugateGradients<double> solver;
    solver.solve(
        scene.system->comm(), residual, x, 0, 1e-9, [&](const auto& z, auto& w) { f.system.product(z, w); },
        [&](const auto& r, auto& z) { preconditioner->apply(r, z); }, f.system.copies());
    for (std::size_t k = 0; k < v.size(); ++k) v[k] += x[k];
    System<double>::Field w(v.size(), 0.0);
    f.system.product(v, w);
    std::vector<double> divergence;
    for (std::size_t i = 0; i < f.system.owned(); ++i) divergence.push_back(f.system.divergence(i));
    const double energy = f.dot(v, w);
    EXPECT_NEAR(disturbanceOf(f.system, v, divergence), energy, 1e-6 * energy);
    EXPECT_LT(leastDisturbance(scene), 1e-3 * energy);
}

// Whatever follows linearly: here the first numbers of A x.
TEST(ConjugateGradients, carriesAlongWhatFollowsFromTheVelocity) {
    constexpr std::size_t size = 30;
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> d(-1, 1);
    Eigen::MatrixXd A = Eigen::MatrixXd::Identity(size, size), C(4, size);
    for (Eigen::Index i = 0; i < A.rows(); ++i)
        for (Eigen::Index k = 0; k < i; ++k) A(i, i) += 1, A(i, k) = A(k, i) = 0.5 * d(random);
    for (double& c : C.reshaped()) c = d(random);
    Eigen::VectorXd b(size);
    for (double& c : b) c = d(random);
    using Solver = ConjugateGradients<double>;
    Solver::Field r(b.begin(), b.end()), x;
    const auto times = [](const Eigen::MatrixXd& m, const Solver::Field& z) {
        return Eigen::VectorXd(m * Eigen::Map<const Eigen::VectorXd>(z.data(), static_cast<Eigen::Index>(z.size())));
    };
    Solver::Carried carried{{7, 7, 7, 7}, {0, 0, 0, 0}};
    Solver solver;
    solver.solve(
        MPI_COMM_SELF, r, x, 0, 1e-10,
        [&](const Solver::Field& z, Solver::Field& w) {
            Eigen::Map<Eigen::VectorXd>(w.data(), size) = times(A, z);
            Eigen::Map<Eigen::VectorXd>(carried.image.data(), 4) = times(C, z);
        },
        [](const Solver::Field& z, Solver::Field& w) { w = z; }, {}, &carried);
    const Eigen::VectorXd expected = C * A.llt().solve(b);
    for (Eigen::Index k = 0; k < 4; ++k) EXPECT_NEAR(carried.value[static_cast<std::size_t>(k)] - 7, expected[k], 1e-8);
}
