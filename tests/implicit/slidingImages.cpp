// Shear without walls, by images that slide past each other. Lengths in spacings, density and shear rate 1.
#include <gtest/gtest.h>

#include <numbers>

#include "coupling/fluidScene.hpp"
#include "coupling/sphereScene.hpp"
#include "implicit/implicitStep.hpp"

using namespace corpuscle;
using namespace corpuscle::implicit;
using coupling::testing::FluidScene;
using coupling::testing::SphereScene;
using particles::ParticleStore;

namespace {

constexpr double rate = 1;

// Makes the images of the box slide past each other with the velocities of the shear flow.
void slide(coupling::Scene& scene, double rate = ::rate) {
    const double length = scene.system->box().size()[2], middle = scene.system->box().middle()[2];
    scene.flow.shearRate = scene.flow.rate = rate;
    scene.flow.gradient = 2;
    scene.flow.slide = rate * length * Vec3::UnitX();
    scene.flow.velocity = [=](const Vec3& x) { return Vec3(rate * (x[2] - middle), 0, 0); };
    scene.system->slideImages(2, scene.flow.slide);
}

// bulkModulus: in mu gammadot.
sph::FluidModel fluid(double viscosity, double bulkModulus = 500) {
    sph::FluidModel m = sph::testing::model("wendlandC2", "linear");
    m.viscosity = viscosity, m.soundSpeed = std::sqrt(bulkModulus * viscosity * rate);
    return m;
}

struct SlidingFluid : FluidScene {
    std::unique_ptr<ImplicitStep> step;

    // disturbance(x): added to the velocity of the flow at the start.
    template <class F>
    SlidingFluid(const Index3& size, double jitter, const sph::FluidModel& model, const ImplicitSettings& settings,
                 F&& disturbance)
        : FluidScene(still(size, jitter), size, model, rate, 0, MPI_COMM_WORLD, particles::Precision::full) {
        slide(scene);
        ParticleStore& s = scene.store();
        for (std::size_t i = 0; i < s.size(); ++i)
            s.setVelocity(i, scene.flow.velocity(s.position(i)) + disturbance(s.position(i)));
        ImplicitStep::Options options;
        options.settings = settings;
        if (jitter > 0) options.shifting = 1;
        scene.budget.kept = true;
        step = ImplicitStep::make(scene, options);
    }
    static std::vector<sph::testing::Particle> still(const Index3& size, double jitter) {
        std::vector<sph::testing::Particle> all = sph::testing::lattice(size, jitter);
        for (sph::testing::Particle& p : all) p.density = p.mass = p.viscosity = 1;
        return all;
    }
    Vec3 disturbance(std::size_t i) const {
        const ParticleStore& s = scene.store();
        return s.velocity(i) - scene.flow.velocity(s.position(i));
    }
};

}  // namespace

// Particles of a disordered fluid pass each other, across the sliding faces as well, for three times as long as it
// takes an image to pass a whole period.
TEST(SlidingImages, shearStaysUniform) {
    constexpr double stepStrain = 0.05;
    SlidingFluid box({10, 8, 12}, 0.2, fluid(1), {.step = stepStrain, .tolerance = 1e-3},
                     [](const Vec3&) { return Vec3(0, 0, 0); });
    for (int k = 0; k < 60; ++k) {
        box.step->advance(stepStrain / rate);
        const double square = box.sum([&](std::size_t i) { return box.disturbance(i).squaredNorm(); });
        const double count = box.sum([](std::size_t) { return 1; });
        ASSERT_LT(std::sqrt(square / count), 0.06 * rate) << "step " << k;  // as between walls (shearedBox.cpp)
        for (std::size_t i = 0; i < box.scene.store().size(); ++i)
            ASSERT_EQ(box.scene.system->periodicity().wrap(box.scene.store().position(i)),
                      box.scene.store().position(i));
    }
    EXPECT_NEAR(box.scene.system->periodicity().offset()[0], 36 - 40, 1e-9) << "at least, of 36 in periods of 10";
}

// A wave in a shear flow (Kelvin): its crests turn with the flow, k = (q, 0, k0 - gammadot t q); viscosity damps it.
// The velocity along y is advected and damped,    u_y = U exp(-nu int k^2 dt) cos(k.x)
// and so is the vorticity of the velocity in the shear plane, which is (k_z, 0, -k_x)/k^2 times the vorticity.
// x is measured from the middle of the box, so that k.x is the same for all images at all times.
TEST(SlidingImages, wavesTurnWithTheFlowAndDecay) {
    constexpr int length = 24;
    constexpr double q = 2 * std::numbers::pi / length, viscosity = 0.25 / (q * q), amplitude = 1e-3, end = 2;
    const Vec3 middle(0, 0, 0.5 * length);
    const auto waveOf = [&](double t) { return Vec3(q, 0, q - rate * t * q); };
    const auto inPlane = [](const Vec3& k) -> Vec3 { return Vec3(k[2], 0, -k[0]) / k.squaredNorm(); };
    const auto wave = [&](const Vec3& x, double t) {
        const Vec3 k = waveOf(t);
        const double phase = k.dot(x - middle);
        return Vec3(0.7 * std::sin(phase) * q * inPlane(k) + Vec3(0, std::cos(phase), 0));
    };
    SlidingFluid box({length, 6, length}, 0, fluid(viscosity, 4000), {.step = 0.02, .tolerance = 1e-5},
                     [&](const Vec3& x) { return Vec3(amplitude * wave(x, 0)); });
    const int steps = 100;
    for (int k = 0; k < steps; ++k) box.step->advance(end / steps);
    const ParticleStore& s = box.scene.store();
    double integral = 0;  // of k^2
    for (int k = 0; k < 1000; ++k) integral += waveOf((k + 0.5) * end / 1000).squaredNorm() * end / 1000;
    const double expected = amplitude * std::exp(-viscosity * integral);
    EXPECT_NEAR(expected, amplitude * std::exp(-0.25 * (2 + 2.0 / 3)), 1e-6 * amplitude);
    for (const Vec3& component : {Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 1)}) {
        const auto along = [&](std::size_t i) { return component.dot(wave(s.position(i), end)); };
        const double found = box.sum([&](std::size_t i) { return component.dot(box.disturbance(i)) * along(i); }) /
                             box.sum([&](std::size_t i) { return along(i) * along(i); });
        EXPECT_NEAR(found / expected, 1, 0.01) << component.transpose();
        const double left =
            box.sum([&](std::size_t i) { return std::pow(component.dot(box.disturbance(i)) - found * along(i), 2); });
        EXPECT_LT(std::sqrt(left / box.sum([](std::size_t) { return 1; })), 0.05 * expected) << component.transpose();
    }
}

namespace {

// A cell in a box of sliding images. up: how far everything is moved along z; half a period puts the cell on the faces.
// slower: factor by which the viscosity is higher and the shear rate lower, for less inertia.
struct CellInShear {
    static constexpr double length = 10;
    coupling::Scene scene;
    std::unique_ptr<ImplicitStep> step;

    explicit CellInShear(double up, double bondStrain = ImplicitSettings{}.bondStrain, double slower = 1)
        : scene(SphereScene({10, 9, 10}, {{5.1, 4.4, 4.7}}, true).immersedScene(rate / slower, [](const Vec3& d) {
              return d;
          })) {
        sph::FluidModel model = fluid(1);
        model.viscosity = slower;
        scene.forces = std::make_unique<sph::FluidForces>(model, *scene.system);
        scene.budget.kept = true;
        slide(scene, rate / slower);
        const Vec3 shift(0, 0, up);
        ParticleStore& s = scene.store();
        for (std::size_t i = 0; i < s.size(); ++i) {
            s.setPosition(i, s.position(i) + shift);
            s.setVelocity(i, scene.flow.velocity(s.position(i)));
        }
        for (coupling::Cell& cell : scene.cells)
            for (std::size_t n = 0; n < cell.membrane.position.size(); ++n) {
                cell.membrane.position[n] += shift;
                cell.membrane.velocity[n] = scene.flow.velocity(cell.membrane.position[n]);
            }
        scene.system->rebuild();
        ImplicitStep::Options options;
        options.settings = {.step = 0.05, .tolerance = 1e-7};
        options.settings.bondStrain = bondStrain;
        options.shifting = 1;
        step = ImplicitStep::make(scene, options);
    }
    // Of the nodes from their middle, and how far that is from where it was; on every rank that holds the cell.
    static std::vector<Vec3> shapeOf(const coupling::Cell& cell) {
        std::vector<Vec3> x = cell.membrane.position;
        const Vec3 middle = coupling::middleOf(cell);
        for (Vec3& one : x) one -= middle;
        return x;
    }
};

}  // namespace

TEST(SlidingImages, aCellOnTheFacesDeformsAsOneInTheMiddle) {
    CellInShear inside(0), across(0.5 * CellInShear::length);
    for (int k = 0; k < 40; ++k) inside.step->advance(0.05 / rate), across.step->advance(0.05 / rate);
    EXPECT_EQ(inside.step->statistics.halvings + across.step->statistics.halvings, 0);
    const auto largest = [](const coupling::Cell& cell) {
        double most = 0;
        for (const Vec3& x : CellInShear::shapeOf(cell)) most = std::max(most, x.norm());
        return most;
    };
    int seen = 0;
    for (const coupling::Cell& cell : inside.scene.cells) {
        EXPECT_GT(largest(cell), 1.1 * coupling::testing::radius) << "it is drawn out";
        const coupling::Cell* const other = across.scene.cells.find(cell.membrane.cell);
        if (!other) continue;  // on other ranks
        ++seen;
        const std::vector<Vec3> one = CellInShear::shapeOf(cell), two = CellInShear::shapeOf(*other);
        for (std::size_t n = 0; n < one.size(); ++n) ASSERT_LT((one[n] - two[n]).norm(), 1e-4) << "node " << n;
        const Vec3 drift = coupling::middleOf(*other) - coupling::middleOf(cell);
        const double across2 = drift[2] > 0 ? 0.5 : -0.5;
        EXPECT_NEAR(drift[2], across2 * CellInShear::length, 1e-4);
    }
    EXPECT_GT(sph::testing::sumOverRanks(seen), 0);
}

// The failed attempt has moved images, and particles across the faces, and has changed the velocities of these
// particles.
TEST(SlidingImages, aStepThatFailsPutsEverythingBack) {
    constexpr double up = 0.5 * CellInShear::length, bondStrain = 0.04;  // the shear gives 0.025 in a step of 0.05
    CellInShear failing(up, bondStrain), parts(up, bondStrain);
    for (int k = 0; k < 10; ++k) failing.step->advance(0.05 / rate), parts.step->advance(0.05 / rate);
    ASSERT_EQ(failing.step->statistics.halvings, 0);
    for (int k = 0; k < 5; ++k) {
        failing.step->advance(0.1 / rate);
        parts.step->damped = true;  // as the halves of a halved step are
        for (int half = 0; half < 2; ++half) parts.step->advance(0.05 / rate);
    }
    EXPECT_EQ(failing.step->statistics.halvings, 5);
    EXPECT_EQ(parts.step->statistics.halvings, 0);
    EXPECT_NEAR(failing.scene.system->periodicity().offset()[0], 0, 1e-9) << "of 10, in a period of 10";
    EXPECT_EQ(failing.scene.system->periodicity().offset(), parts.scene.system->periodicity().offset());
    const auto work = [](const CellInShear& box) {
        return sph::testing::sumOverRanks(box.scene.budget.total[sph::Budget::ofImages]);
    };
    EXPECT_NEAR(work(failing) / work(parts), 1, 1e-6) << "crossings of the failed attempt are taken back";
    for (const coupling::Cell& cell : failing.scene.cells) {
        const coupling::Cell* const other = parts.scene.cells.find(cell.membrane.cell);
        ASSERT_TRUE(other);
        for (std::size_t n = 0; n < cell.membrane.position.size(); ++n)
            ASSERT_LT((cell.membrane.position[n] - other->membrane.position[n]).norm(), 1e-6) << "node " << n;
    }
}

namespace {

// Mean power of the images over the next steps, over mu gammadot^2 V.
template <class Box>
double powerOfImages(Box& box, int steps, double dt) {
    const auto work = [&] { return sph::testing::sumOverRanks(box.scene.budget.total[sph::Budget::ofImages]); };
    const double before = work(), rate = box.scene.flow.shearRate;
    for (int k = 0; k < steps; ++k) box.step->advance(dt);
    return (work() - before) /
           (steps * dt * box.scene.model().viscosity * rate * rate * box.scene.system->box().volume());
}

}  // namespace

// The power of the images corresponds to the shear stress of the fluid.
TEST(SlidingImages, workAsMuchAsTheFluidDissipates) {
    constexpr double dt = 0.05 / rate;
    SlidingFluid box({10, 8, 12}, 0.2, fluid(40), {.step = 0.05, .tolerance = 1e-7},
                     [](const Vec3&) { return Vec3(0, 0, 0); });
    for (int k = 0; k < 4; ++k) box.step->advance(dt);
    EXPECT_NEAR(powerOfImages(box, 10, dt), 1, 0.03);
}

// A stream across the faces carries a wave along: momentum changes by what crosses the faces, and energy by the work of
// the images less what the fluid dissipates.
TEST(SlidingImages, whatCrossesTheFacesGainsMomentumAndEnergy) {
    constexpr double dt = 0.01 / rate;
    constexpr int length = 12;
    SlidingFluid box({length, 6, length}, 0, fluid(0.5), {.step = 0.01, .tolerance = 1e-9},
                     [](const Vec3& x) { return Vec3(0, 0.3 * std::sin(2 * std::numbers::pi * x[2] / length), 2); });
    const ParticleStore& s = box.scene.store();
    const auto energy = [&] { return box.sum([&](std::size_t i) { return 0.5 * s.velocity(i).squaredNorm(); }); };
    const auto momentum = [&] {
        Vec3 sum;
        for (int k = 0; k < 3; ++k) sum[k] = box.sum([&](std::size_t i) { return s.velocity(i)[k]; });
        return sum;
    };
    const auto total = [&](std::size_t entry) { return sph::testing::sumOverRanks(box.scene.budget.total[entry]); };
    const auto impulse = [&] {
        Vec3 sum;
        for (int k = 0; k < 3; ++k) sum[k] = total(sph::Budget::images + static_cast<std::size_t>(k));
        return sum;
    };
    for (int k = 0; k < 4; ++k) box.step->advance(dt);
    const Vec3 before = momentum(), had = impulse();
    const double energyBefore = energy(), worked = total(sph::Budget::ofImages),
                 lost = total(sph::Budget::viscous) + total(sph::Budget::compression);
    for (int k = 0; k < 50; ++k) box.step->advance(dt);
    const Vec3 gained = impulse() - had;
    EXPECT_GT(gained.norm(), 0.9 * length * 6 * length * rate) << "a twelfth of the box for each of its planes";
    EXPECT_LT((momentum() - before - gained).norm(), 1e-5 * gained.norm());
    const double work = total(sph::Budget::ofImages) - worked,
                 left = total(sph::Budget::viscous) + total(sph::Budget::compression) - lost;
    EXPECT_NEAR(energy() - energyBefore, work - left, 0.01 * work);
}

// Across a face that cuts a cell, the forces include those of its membrane: the stress from the power of the images is
// that of fluid and membrane, wherever the faces are.
TEST(SlidingImages, stressByImagesIsThatOfFluidAndCell) {
    constexpr double slower = 30, dt = 0.05 * slower / rate;
    const double bondStrain = ImplicitSettings{}.bondStrain;
    CellInShear inside(0, bondStrain, slower), across(0.5 * CellInShear::length, bondStrain, slower),
        high(0.31 * CellInShear::length, bondStrain, slower);
    for (int k = 0; k < 30; ++k) inside.step->advance(dt), across.step->advance(dt), high.step->advance(dt);
    const double stress = powerOfImages(inside, 10, dt);
    EXPECT_NEAR(powerOfImages(across, 10, dt), stress, 2e-3 * stress);
    EXPECT_NEAR(powerOfImages(high, 10, dt), stress, 2e-3 * stress);
    double ofCell = 0;
    for (const coupling::Cell& cell : inside.scene.cells) {
        if (!cell.isOwnedBy(inside.scene.system->decomposition().rank())) continue;
        const std::vector<Vec3>& x = cell.membrane.position;
        std::vector<Vec3> force(x.size(), Vec3::Zero());
        cell.membrane.addElasticForces(x, force);
        for (std::size_t n = 0; n < x.size(); ++n) ofCell -= x[n][2] * force[n][0];
    }
    ofCell = sph::testing::sumOverRanks(ofCell) / (rate * inside.scene.system->box().volume());  // mu gammadot: 1
    EXPECT_GT(ofCell, 0.06);
    EXPECT_NEAR(stress, 1 + ofCell, 0.015);  // the viscosity of the disordered particles is 0.8 % low
}
