// A sheared box of disordered fluid between walls: plane Couette flow that particles must not disturb as they pass each
// other. Lengths in spacings, density and viscosity 1.
#include "implicit/implicitStep.hpp"

#include <gtest/gtest.h>

#include "coupling/fluidScene.hpp"

using namespace corpuscle;
using namespace corpuscle::implicit;
using coupling::testing::FluidScene;
using particles::ParticleStore;

namespace {

constexpr double jitter = 0.2, stepStrain = 0.05;
constexpr int strains = 20, strainsOfWindow = 2, layers = 3;
const Index3 size{12, 12, 20 + 2 * layers};

struct ShearedBox : FluidScene {
    static constexpr double gap = 20, rate = 1, low = layers;
    std::unique_ptr<ImplicitStep> step;

    static Vec3 velocity(const Vec3& x) { return {rate * (x[2] - low - 0.5 * gap), 0, 0}; }

    static sph::FluidModel model() {
        sph::FluidModel m = sph::testing::model("wendlandC2", "linear");
        m.viscosity = 1, m.soundSpeed = std::sqrt(500.0);  // bulk modulus 500 mu gammadot
        m.walls = boundary::testing::planes(2, low, low + gap, velocity({0, 0, low}), velocity({0, 0, low + gap}));
        return m;
    }
    ShearedBox()
        : FluidScene(coupling::testing::sheared(size, jitter, model().walls, velocity), size, model(), rate, 0,
                     MPI_COMM_WORLD, particles::Precision::full) {
        scene.fluidBox.low[2] = low, scene.fluidBox.high[2] = low + gap;
        scene.flow.shearRate = rate;
        scene.flow.velocity = velocity;
        ImplicitStep::Options options;
        options.settings = {.step = stepStrain, .tolerance = 1e-3};
        options.shifting = 1;
        step = ImplicitStep::make(scene, options);
    }

    // Mean shear stress on the two walls, in units of mu gammadot.
    double stress() const {
        const double both = scene.forces->wallForces()[0][0] - scene.forces->wallForces()[1][0];
        return sph::testing::sumOverRanks(both) / (2 * size[0] * size[1]);
    }
    // Root mean square deviation of the velocity from the flow, in units of the velocity difference of the walls.
    double noise() const {
        const ParticleStore& s = scene.store();
        double square = 0, count = 0;
        for (std::size_t i = 0; i < s.size(); ++i) {
            if (s.kindOf(i) != particles::Kind::fluid) continue;
            square += (s.velocity(i) - velocity(s.position(i))).squaredNorm(), count += 1;
        }
        return std::sqrt(sph::testing::sumOverRanks(square) / sph::testing::sumOverRanks(count)) / (rate * gap);
    }
};

TEST(ShearedBox, stressAndVelocityStayThoseOfCouetteFlow) {
    ShearedBox box;
    const double dt = stepStrain / ShearedBox::rate;
    for (int window = 0; window < strains / strainsOfWindow; ++window) {
        const int steps = static_cast<int>(std::lround(strainsOfWindow / stepStrain));
        double stress = 0;
        for (int k = 0; k < steps; ++k) {
            box.step->advance(dt);
            stress += box.stress() / steps;
            EXPECT_LT(box.noise(), 0.003);
        }
        EXPECT_NEAR(stress, 1, 0.003) << "strain " << (window + 1) * strainsOfWindow;
    }
}

}  // namespace
