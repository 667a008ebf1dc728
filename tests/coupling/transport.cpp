// Shifting fills a void between particles, faster where cells may touch. Lengths in spacings, density 1.
#include "coupling/transport.hpp"

#include <gtest/gtest.h>

#include "coupling/fluidScene.hpp"

using namespace corpuscle;
using namespace corpuscle::coupling;
using coupling::testing::FluidScene;

namespace {

constexpr double rate = 2, strainOfStep = 0.01, hole = 1.8;
const Index3 size{12, 12, 12};

sph::FluidModel model() {
    sph::FluidModel m = sph::testing::model("wendlandC2", "linear");
    m.viscosity = 1;
    return m;
}

struct Void : FluidScene {
    sph::Operators<double> operators{model(), *scene.system, sph::OperatorForm::corrected};
    Transport transport{scene, 3.0};
    double longest = 0;  // of any displacement

    explicit Void(bool withContact)
        : FluidScene(coupling::testing::withHole(size, hole), size, model(), rate, 0.3, MPI_COMM_WORLD,
                     particles::Precision::full) {
        if (withContact)
            scene.contacts = std::make_unique<CellContacts>(contact::ContactSettings{}, scene.model().walls);
        scene.system->start();
        operators.build(*scene.system);
    }
    void shift(int steps) {
        for (int k = 0; k < steps; ++k) {
            transport.shift(operators, strainOfStep / rate);
            particles::ParticleStore& s = scene.store();
            for (std::size_t i = 0; i < s.size(); ++i) {
                s.setPosition(i, s.position(i) + transport[i]);
                longest = std::max(longest, transport[i].norm());
            }
            scene.system->rebuild();
            operators.build(*scene.system);
        }
        MPI_Allreduce(MPI_IN_PLACE, &longest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    }
    // Least sum_j V_j W of any particle: 1 in an even distribution.
    double leastEvenness() const {
        double least = 1;
        for (std::size_t i = 0; i < scene.store().size(); ++i) least = std::min(least, operators.evenness(i));
        MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
        return least;
    }
};

}  // namespace

TEST(Transport, movesAtMostSoManySpacingsPerUnitOfStrain) {
    for (const auto& [withContact, spacings] : {std::pair{false, 1}, std::pair{true, 4}}) {
        Void scene(withContact);
        scene.shift(1);
        EXPECT_NEAR(scene.longest, spacings * strainOfStep, 1e-12);
    }
}

TEST(Transport, fillsAVoid) {
    Void apart(false), together(true);
    const double before = apart.leastEvenness();
    EXPECT_LT(before, 0.8);
    EXPECT_EQ(together.leastEvenness(), before);
    for (Void* scene : {&apart, &together}) scene->shift(50);
    EXPECT_LT(apart.leastEvenness(), 0.93);
    EXPECT_GT(together.leastEvenness(), 0.96);
}
