// Fluid alone: decay of a shear wave, start-up of plane Couette flow, conservation of momentum, independence of the
// number of ranks. Lengths in spacings, density 1.
#include "implicit/implicitStep.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "coupling/fluidScene.hpp"

using namespace corpuscle;
using namespace corpuscle::implicit;
using coupling::testing::FluidScene;
using coupling::testing::still;
using sph::testing::Particle;

namespace {

constexpr double pi = std::numbers::pi;

struct ImplicitFluid : FluidScene {
    std::unique_ptr<ImplicitStep> step;

    ImplicitFluid(const std::vector<Particle>& all, const Index3& size, const sph::FluidModel& model, double rate,
                  const ImplicitSettings& settings, MPI_Comm comm = MPI_COMM_WORLD,
                  particles::Precision precision = particles::Precision::full)
        : FluidScene(all, size, model, rate, 0, comm, precision) {
        ImplicitStep::Options options;
        options.settings = settings;
        options.settings.step = 0.1;  // the key of a case; here advance() is given the step
        step = ImplicitStep::make(scene, options);
    }
    void run(double time, int steps) {
        for (int k = 0; k < steps; ++k) step->advance(time / steps);
    }
};

ImplicitSettings exactly(const std::string& method) { return {.step = 0, .tolerance = 1e-9, .method = method}; }

// u = U sin(k z): its amplitude decays as exp(-rate t), with the rate that the operator has on the lattice.
struct ShearWave {
    static constexpr double amplitude = 1e-4, length = 12;
    const Index3 size{4, 4, 12};
    sph::FluidModel model = sph::testing::model("wendlandC2", "linear");
    std::vector<Particle> all = still(size);
    double rate = 0;
    static double shape(double z) { return std::sin(2 * pi * z / length); }

    ShearWave() {
        for (Particle& p : all) p.u[0] = amplitude * shape(p.x[2]);
        ImplicitFluid lattice(all, size, model, 1e-4, exactly("midpoint"));
        const auto& s = lattice.scene.store();
        sph::Operators<double> operators(model, *lattice.scene.system, sph::OperatorForm::corrected);
        operators.build(*lattice.scene.system);
        sph::Operators<double>::Field u(4 * s.size(), 0.0);
        for (std::size_t i = 0; i < s.size(); ++i) u[4 * i] = s.u[i];
        operators.apply(*lattice.scene.system, u, [](std::size_t, double) { return 0.0; });
        rate = -lattice.sum([&](std::size_t i) { return u[4 * i] * operators.force()[4 * i]; }) /
               lattice.sum([&](std::size_t i) { return u[4 * i] * u[4 * i]; });
    }
    // Relative error of the amplitude at the end, or at a time `before` the end, extrapolated back with the
    // acceleration.
    double error(const std::string& method, double time, int steps, double before = 0) const {
        ImplicitFluid wave(all, size, model, 1e-4, exactly(method));
        wave.run(time, steps);
        const auto& s = wave.scene.store();
        const double found = wave.sum([&](std::size_t i) { return (s.u[i] - before * s.fx[i]) * shape(s.z[i]); }) /
                             wave.sum([&](std::size_t i) { return std::pow(shape(s.z[i]), 2); });
        return found / amplitude - std::exp(-rate * (time - before));
    }
};

}  // namespace

TEST(ImplicitStep, shearWaveDecaysAtTheRateOfTheFluid) {
    const ShearWave wave;
    const double k = 2 * pi / ShearWave::length;
    EXPECT_NEAR(wave.rate, wave.model.viscosity * k * k, 0.05 * wave.rate) << "the kernel smooths";
    EXPECT_GT(wave.rate, 0.1);
}

// The formulas of implicit/timeDifference.hpp, applied to du/dt = -rate u: without a history, first over half a step,
// then from middle to middle, and at last from the last middle to the end.
TEST(ImplicitStep, midpointStepsAsItsFormulasSay) {
    const ShearWave wave;
    const double time = 1 / wave.rate, dt = time / 8;
    double u = 1, a = 0, before = 0;
    for (int k = 0; k < 8; ++k) {
        const double h = k == 0 ? dt / 2 : dt, w = k == 0 ? 0 : h / before;
        const double c1 = (1 + 2 * w) / (h * (1 + w)), c2 = w / (1 + w), v = (c1 * u + c2 * a) / (c1 + wave.rate);
        a = (v - u) / h, u = v, before = h;
    }
    EXPECT_NEAR(wave.error("midpoint", time, 8, dt / 2), u - std::exp(-wave.rate * (time - dt / 2)), 1e-7);
    EXPECT_NEAR(wave.error("midpoint", time, 8), u + dt / 2 * a - std::exp(-1), 1e-7);
}

TEST(ImplicitStep, midpointIsOfSecondOrder) {
    const ShearWave wave;
    const double time = 1 / wave.rate, coarse = wave.error("midpoint", time, 64),
                 fine = wave.error("midpoint", time, 128), finest = wave.error("midpoint", time, 256);
    EXPECT_LT(std::abs(wave.error("midpoint", time, 8, time / 16)), 2e-4) << "in the middle of the last step";
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.15);
    EXPECT_NEAR(std::log2(fine / finest), 2, 0.1);
}

// A wave starts fully developed: already after the first step the store has the velocity at the end of the step, not
// that at its middle.
TEST(ImplicitStep, firstStepOfADecayingFlowEndsAtItsEnd) {
    const ShearWave wave;
    const double step = 0.1;  // of 1/rate
    EXPECT_NEAR(wave.error("midpoint", step / wave.rate, 1), 0, step * step);
}

// The wave decays at the same rate everywhere: v - v0 is (rate dt)^2 times its root mean square. The next step is that
// for which a 24th of this, over the length and the rate of the flow, is the allowed error.
TEST(ImplicitStep, stepOfAFluidIsAsLongAsItsErrorAllows) {
    const ShearWave wave;
    const double dt = 0.05 / wave.rate, flowRate = 0.3, length = 2;
    ImplicitSettings settings = exactly("midpoint");
    settings.error = 1e-8;
    ImplicitFluid fluid(wave.all, wave.size, wave.model, flowRate, settings);
    fluid.scene.flow.length = length;
    const int steps = 8;
    fluid.run(steps * dt, steps);
    const double v = ShearWave::amplitude * std::sqrt(0.5) * std::exp(-wave.rate * (steps - 0.5) * dt);
    const double error = std::pow(wave.rate * dt, 2) * v / (24 * flowRate * length);
    EXPECT_NEAR(fluid.step->allowed().error, dt * std::sqrt(settings.error / error), 0.1 * fluid.step->allowed().error);
    EXPECT_EQ(fluid.step->allowed().bond, 0);
}

// The local error of backward Euler is that of the first difference of velocity, not of the second.
TEST(ImplicitStep, stepOfAFluidByBackwardEulerIsAsLongAsItsErrorAllows) {
    const ShearWave wave;
    const double dt = 0.05 / wave.rate, flowRate = 0.3, length = 2;
    const int steps = 8;
    const double v = ShearWave::amplitude * std::sqrt(0.5) * std::pow(1 + wave.rate * dt, -steps);
    const double error = wave.rate * dt * v / (2 * flowRate * length);
    ImplicitSettings settings = exactly("backwardEuler");
    settings.error = 0.7 * error;
    ImplicitFluid fluid(wave.all, wave.size, wave.model, flowRate, settings);
    fluid.scene.flow.length = length;
    fluid.run(steps * dt, steps);
    EXPECT_NEAR(fluid.step->allowed().error / dt, 0.7, 0.01);
}

TEST(ImplicitStep, backwardEulerIsOfFirstOrder) {
    const ShearWave wave;
    const double time = 1 / wave.rate;
    EXPECT_NEAR(std::log2(wave.error("backwardEuler", time, 16) / wave.error("backwardEuler", time, 32)), 1, 0.1);
    const double q = 1 / (1 + 1.0 / 16);
    EXPECT_NEAR(wave.error("backwardEuler", time, 16), std::pow(q, 16) - std::exp(-1), 1e-6)
        << "1/(1 + rate dt) a step";
}

// The textbook series: u/U = z/h - sum 2/(n pi) (-1)^(n+1) exp(-(n pi/h)^2 nu t) sin(n pi z/h).
TEST(ImplicitStep, plateFlowStartsAsItShould) {
    const Index3 size{4, 4, 22};
    const double low = 3, gap = 16, speed = 1e-3, nu = 0.7, time = 0.1 * gap * gap / nu;
    const int steps = 40;
    sph::FluidModel model = sph::testing::model("wendlandC2", "linear");
    model.walls = boundary::testing::planes(2, low, low + gap, Vec3::Zero(), Vec3(speed, 0, 0));
    std::vector<Particle> all = still(size);
    for (Particle& p : all) {
        p.wall = p.x[2] < low || p.x[2] > low + gap;
        if (p.x[2] > low + gap) p.u[0] = speed;
    }
    ImplicitFluid couette(all, size, model, speed / gap, exactly("midpoint"));
    couette.run(time, steps);
    const auto exact = [&](double z, double at) {
        double u = z / gap;
        for (int n = 1; n < 40; ++n)
            u -= 2 / (n * pi) * (n % 2 ? 1 : -1) * std::exp(-std::pow(n * pi / gap, 2) * nu * at) *
                 std::sin(n * pi * z / gap);
        return u;
    };
    const double middle = time * (1 - 0.5 / steps);
    const auto& s = couette.scene.store();
    double worst = 0, stress = -exact(1e-3, middle) / 1e-3 * model.viscosity * speed;
    for (std::size_t i = 0; i < s.size(); ++i)
        if (s.kindOf(i) == particles::Kind::fluid)
            worst = std::max(worst, std::abs(s.u[i] / speed - exact(s.z[i] - low, time)));
    MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    EXPECT_LT(worst, 0.01);
    EXPECT_GT(exact(0.25 * gap, time), 0.02);
    EXPECT_LT(exact(0.25 * gap, time), 0.24) << "still on its way to 0.25";
    // The fluid drags the lower wall along: the force on the wall follows from the slope of the profile there, in the
    // middle of the step.
    const double onWall = sph::testing::sumOverRanks(couette.scene.forces->wallForces()[0][0]);
    EXPECT_NEAR(onWall / (size[0] * size[1]), -stress, 0.05 * std::abs(stress));
}

TEST(ImplicitStep, keepsMomentumAndTakesEnergyAway) {
    const Index3 size{6, 6, 8};
    std::vector<Particle> all = sph::testing::lattice(size, 0.15);
    for (Particle& p : all) p.u *= 0.02, p.density = p.mass = p.viscosity = 1;
    for (const auto precision : {particles::Precision::full, particles::Precision::mixed}) {
        const bool full = precision == particles::Precision::full;
        ImplicitSettings settings = exactly("midpoint");
        if (!full) settings.tolerance = 1e-5;
        ImplicitFluid box(all, size, sph::testing::model("wendlandC2"), 0.02, settings, MPI_COMM_WORLD, precision);
        const auto& s = box.scene.store();
        const auto momentum = [&] {
            return Vec3(box.sum([&](std::size_t i) { return s.u[i]; }), box.sum([&](std::size_t i) { return s.v[i]; }),
                        box.sum([&](std::size_t i) { return s.w[i]; }));
        };
        const auto energy = [&] { return box.sum([&](std::size_t i) { return s.velocity(i).squaredNorm(); }); };
        const Vec3 before = momentum();
        const double most = energy(), size2 = std::sqrt(most * static_cast<double>(all.size()));
        box.run(4, 8);
        EXPECT_LT((momentum() - before).norm(), (full ? 1e-8 : 1e-5) * size2);
        EXPECT_LT(energy(), 0.5 * most);
    }
}

TEST(ImplicitStep, isTheSameOnOneRankAndOnAll) {
    const Index3 size{7, 6, 8};
    std::vector<Particle> all = sph::testing::lattice(size, 0.15);
    for (Particle& p : all) p.u *= 0.02, p.density = p.mass = p.viscosity = 1;
    ImplicitSettings settings;
    settings.tolerance = 1e-7;
    const sph::FluidModel model = sph::testing::model("wendlandC2");
    ImplicitFluid alone(all, size, model, 0.02, settings, MPI_COMM_SELF), shared(all, size, model, 0.02, settings);
    alone.run(4, 8), shared.run(4, 8);
    std::map<std::int64_t, std::size_t> place;
    for (std::size_t i = 0; i < alone.scene.store().size(); ++i) place[alone.scene.store().id[i]] = i;
    const auto &a = alone.scene.store(), &b = shared.scene.store();
    const double largest = std::sqrt(shared.sum([&](std::size_t i) { return b.velocity(i).squaredNorm(); }));
    for (std::size_t i = 0; i < b.size(); ++i)
        EXPECT_LT((a.velocity(place.at(b.id[i])) - b.velocity(i)).norm(), 1e-6 * largest);
}
