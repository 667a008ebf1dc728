// The explicit step with adjoint operators: decay of a shear wave, limits of the step against dense matrices,
// conservation of momentum, independence of the number of ranks, spherical membranes. Lengths in spacings, density 1.
#include "coupling/adjointVerlet.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <map>
#include <numbers>

#include "coupling/fluidScene.hpp"
#include "coupling/sphereScene.hpp"

using namespace corpuscle;
using namespace corpuscle::coupling;
using coupling::testing::FluidScene;
using coupling::testing::fluidSupport;
using coupling::testing::SphereScene;
using coupling::testing::still;
using sph::testing::Particle;

namespace {

constexpr double skin = 0.3, pi = std::numbers::pi;

struct ExplicitFluid : FluidScene {
    std::unique_ptr<AdjointVerlet> step;

    ExplicitFluid(const std::vector<Particle>& all, const Index3& size, const sph::FluidModel& model, double rate,
                  MPI_Comm comm = MPI_COMM_WORLD, particles::Precision precision = particles::Precision::full)
        : FluidScene(all, size, model, rate, skin, comm, precision) {
        step = AdjointVerlet::make(scene, {});
        step->start();
    }
    void run(double time, int steps) {
        for (int k = 0; k < steps; ++k) step->advance(time / steps);
    }
    double energy() const {
        return sum([&](std::size_t i) { return scene.store().velocity(i).squaredNorm(); });
    }
};

// Eigenvalue of M^-1 L on a lattice for a wave k that fits the box: sum_j 2 nu F (1 - cos k.d)/S2, with the kernel as
// printed in the literature.
double latticeRate(double viscosity, const Index3& size, const Index3& wave) {
    const auto sum = [&](auto&& term) {
        double total = 0;
        for (int a = -3; a <= 3; ++a)
            for (int b = -3; b <= 3; ++b)
                for (int c = -3; c <= 3; ++c) {
                    const Vec3 d(a, b, c);
                    if (const double r = d.norm(); r > 0)
                        total += -sph::testing::kernelDerivative("wendlandC2", r, fluidSupport) / r * term(d);
                }
        return total;
    };
    const double S2 = sum([](const Vec3& d) { return d.squaredNorm() / 3; });
    return sum([&](const Vec3& d) {
        double phase = 0;
        for (int k = 0; k < 3; ++k) phase += 2 * pi * wave[static_cast<std::size_t>(k)] * d[k] / size[k];
        return 2 * viscosity / S2 * (1 - std::cos(phase));
    });
}

// u = U sin(k z) decays as exp(-rate t).
struct ShearWave {
    static constexpr double amplitude = 1e-4, length = 12;
    const Index3 size{4, 4, 12};
    sph::FluidModel model = sph::testing::model("wendlandC2", "linear");
    std::vector<Particle> all = still(size);
    double rate = latticeRate(model.viscosity, size, {0, 0, 1});
    static double shape(double z) { return std::sin(2 * pi * z / length); }

    ShearWave() {
        for (Particle& p : all) p.u[0] = amplitude * shape(p.x[2]);
    }
    double amplitudeAfter(double time, int steps) const {
        ExplicitFluid wave(all, size, model, 1e-4);
        wave.run(time, steps);
        const auto& s = wave.scene.store();
        return wave.sum([&](std::size_t i) { return s.u[i] * shape(s.z[i]); }) /
               wave.sum([&](std::size_t i) { return std::pow(shape(s.z[i]), 2); }) / amplitude;
    }
};

// Two spherical membranes, pulled out of shape, in fluid at rest.
struct TwoSpheres : SphereScene {
    Scene scene;
    std::unique_ptr<AdjointVerlet> step;

    explicit TwoSpheres(bool viscous = false)
        : SphereScene({14, 10, 10}, {Vec3(3.5, 0.2, 9.5), Vec3(10.5, 5, 5)}, true, Cells::everywhere,
                      [=](membrane::MembraneSettings& laws) {
                          if (viscous) laws.viscosity = {0.3, 0.5};
                      }) {
        for (Cell& cell : cells) {
            const Vec3 middle = middleOf(cell);
            for (Vec3& x : cell.membrane.position) {
                const Vec3 d = x - middle;
                x = middle + Vec3(1.05 * d[0], 0.98 * d[1], 0.97 * d[2]);
            }
            cell.initialVolume = cell.membrane.volume();
        }
        scene.system = std::move(system);
        scene.cells = std::move(cells);
        scene.fluidBox = scene.system->box();
        scene.fluidVolume = scene.fluidBox.volume();
        scene.spacing = 1;
        scene.flow.rate = 0.02;
        scene.forces = std::make_unique<sph::FluidForces>(sph::testing::model("wendlandC2"), *scene.system);
        step = AdjointVerlet::make(scene, {.shifting = 1.0});
        step->start();
    }
    // The largest eigenvalue of P S M^-1 S^T P A (S, P: coupling/immersed.hpp), whose eigenvalues are those of M^-1 S^T
    // P A P S. A is the matrix on the nodes that `product` applies; the masses M are 1.
    template <class F>
    double largest(F&& product) const {
        Immersed immersed(const_cast<coupling::Cells&>(scene.cells), scene.model(), *scene.system);
        std::vector<double> volume(scene.store().size(), 1.0);
        for (std::size_t i = 0; i < volume.size(); ++i) volume[i] = 1 / scene.store().density[i];
        immersed.place(*scene.system, volume);
        const std::size_t nodes = immersed.force().size();
        const auto columns = static_cast<Eigen::Index>(3 * nodes);
        Eigen::MatrixXd matrix(columns, columns);
        for (Eigen::Index c = 0; c < columns; ++c) {
            Immersed::Vectors unit(nodes, Vec3::Zero());
            unit[static_cast<std::size_t>(c / 3)][c % 3] = 1;
            particles::RealArray force(4 * scene.store().size(), 0.0);
            immersed.spread(product(immersed, unit), force);
            const Immersed::Vectors found = immersed.interpolate(force.data());
            matrix.col(c) = Eigen::Map<const Eigen::VectorXd>(found.front().data(), columns);
        }
        return Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues().real().maxCoeff();
    }
};

}  // namespace

// The formulas of coupling/adjointVerlet.hpp, applied to du/dt = -rate u.
TEST(AdjointVerlet, stepsAsItsFormulasSay) {
    const ShearWave wave;
    const double dt = 0.4 / latticeRate(wave.model.viscosity, wave.size, {2, 2, 6});
    double u = 1, a = -wave.rate;
    for (int k = 0; k < 12; ++k) a = -wave.rate * (u + dt / 2 * a), u += dt * a;
    EXPECT_NEAR(wave.amplitudeAfter(12 * dt, 12), u, 1e-7);
    EXPECT_LT(u, 0.95);
}

TEST(AdjointVerlet, isOfSecondOrder) {
    const ShearWave wave;
    const double time = 1 / wave.rate;
    double error[3];
    for (int k = 0; k < 3; ++k) error[k] = wave.amplitudeAfter(time, 32 << k) - std::exp(-1);
    EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.15);
    EXPECT_NEAR(std::log2(error[1] / error[2]), 2, 0.1);
}

TEST(AdjointVerlet, viscousRateIsThatOfTheLattice) {
    const Index3 size{6, 6, 8};
    const sph::FluidModel model = sph::testing::model("wendlandC2");
    double exact = 0;
    for (int a = 0; a < size[0]; ++a)
        for (int b = 0; b < size[1]; ++b)
            for (int c = 0; c < size[2]; ++c) exact = std::max(exact, latticeRate(model.viscosity, size, {a, b, c}));
    for (const auto precision : {particles::Precision::full, particles::Precision::mixed}) {
        ExplicitFluid box(still(size), size, model, 0.02, MPI_COMM_WORLD, precision);
        const double rate = box.step->rates(100).viscous;
        EXPECT_LT(rate, exact * (1 + 1e-5));
        EXPECT_GT(rate, exact * 0.97);
        EXPECT_EQ(box.step->rates(5).spring2, 0) << "no membrane here";
    }
}

TEST(AdjointVerlet, isStableUpToItsViscousLimitAndNotBeyond) {
    const Index3 size{6, 6, 8};
    sph::FluidModel model = sph::testing::model("wendlandC2", "linear");
    model.soundSpeed = 0.3;
    std::vector<Particle> all = still(size, 0.1);
    for (Particle& p : all) p.u *= 1e-3;
    for (const double share : {0.97, 1.1}) {
        ExplicitFluid box(all, size, model, 0.02);
        const double dt = share / box.step->rates(200).viscous;
        box.run(60 * dt, 60);
        const double before = box.energy();
        box.run(30 * dt, 30);
        if (share < 1)
            EXPECT_LT(box.energy(), before);
        else
            EXPECT_GT(box.energy(), 10 * before);
    }
}

TEST(AdjointVerlet, springRateIsTheLargestEigenvalueOfWhatTheFluidFeels) {
    TwoSpheres cells;
    const double rate2 = cells.step->rates(300).spring2;
    constexpr double step = 1e-5;
    const double exact = cells.largest([&](const Immersed& immersed, const Immersed::Vectors& unit) {
        Immersed::Vectors forth = unit, back = unit;
        for (Vec3& v : forth) v *= step;
        for (Vec3& v : back) v *= -step;
        forth = immersed.forceAt(forth), back = immersed.forceAt(back);
        for (std::size_t m = 0; m < forth.size(); ++m) forth[m] = (back[m] - forth[m]) / (2 * step);
        return forth;
    });
    EXPECT_NEAR(rate2, exact, 0.01 * exact);
}

TEST(AdjointVerlet, membraneRateIsTheLargestEigenvalueOfItsDamping) {
    EXPECT_EQ(TwoSpheres(false).step->rates(5).membrane, 0);
    TwoSpheres cells(true);
    const double rate = cells.step->rates(300).membrane;
    const double exact = cells.largest([](const Immersed& immersed, const Immersed::Vectors& unit) {
        Immersed::Vectors f(unit.size(), Vec3::Zero());
        immersed.addViscousForces(unit, f);
        for (Vec3& v : f) v = -v;
        return f;
    });
    EXPECT_NEAR(rate, exact, 0.01 * exact);
}

TEST(AdjointVerlet, keepsMomentumAndTakesEnergyAway) {
    const Index3 size{6, 6, 8};
    const std::vector<Particle> all = still(size, 0.15);
    for (const auto precision : {particles::Precision::full, particles::Precision::mixed}) {
        ExplicitFluid box(all, size, sph::testing::model("wendlandC2"), 0.02, MPI_COMM_WORLD, precision);
        const auto& s = box.scene.store();
        const auto momentum = [&] {
            return Vec3(box.sum([&](std::size_t i) { return s.u[i]; }), box.sum([&](std::size_t i) { return s.v[i]; }),
                        box.sum([&](std::size_t i) { return s.w[i]; }));
        };
        const Vec3 before = momentum();
        const double most = box.energy();
        box.run(4, 100);
        EXPECT_LT((momentum() - before).norm(), (precision == particles::Precision::full ? 1e-12 : 1e-5) *
                                                    std::sqrt(most * static_cast<double>(all.size())));
        EXPECT_LT(box.energy(), 0.5 * most);
    }
}

TEST(AdjointVerlet, isTheSameOnOneRankAndOnAll) {
    const Index3 size{7, 6, 8};
    const std::vector<Particle> all = still(size, 0.15);
    const sph::FluidModel model = sph::testing::model("wendlandC2");
    ExplicitFluid alone(all, size, model, 0.02, MPI_COMM_SELF), shared(all, size, model, 0.02);
    alone.run(4, 100), shared.run(4, 100);
    std::map<std::int64_t, std::size_t> place;
    const auto &a = alone.scene.store(), &b = shared.scene.store();
    for (std::size_t i = 0; i < a.size(); ++i) place[a.id[i]] = i;
    const double largest = std::sqrt(shared.energy());
    for (std::size_t i = 0; i < b.size(); ++i)
        EXPECT_LT((a.velocity(place.at(b.id[i])) - b.velocity(i)).norm(), 1e-10 * largest);
}

// Two deformed spheres relax towards their shape in the fluid and keep their volume; no particle passes their
// membranes.
TEST(AdjointVerlet, membranesMoveTheFluidAndKeepTheirVolume) {
    TwoSpheres cells(true);
    const auto energy = [&] {
        double sum = 0;
        for (const Cell& cell : cells.scene.cells) sum += cell.membrane.energy();
        return sum;
    };
    const double before = energy();
    const AdjointVerlet::Rates rates = cells.step->rates(50);
    const double drag = rates.viscous + rates.membrane,
                 dt = 0.9 * std::min(2 / rates.spring2 * (std::sqrt(drag * drag + rates.spring2) - drag), 1 / drag);
    const auto crossings = [&] {
        return sph::testing::sumOverRanks(static_cast<double>(cells.step->noFlux()->crossings()));
    };
    cells.step->advance(dt);
    const double atFirst = crossings();  // particles whose side was set before the spheres were deformed
    for (int k = 1; k < 100; ++k) cells.step->advance(dt);
    EXPECT_LT(energy(), 0.9 * before);
    EXPECT_EQ(cells.step->steps(), 100);
    for (const Cell& cell : cells.scene.cells) EXPECT_NEAR(cell.membrane.volume() / cell.initialVolume, 1, 1e-9);
    EXPECT_EQ(crossings(), atFirst);
}
