#include <gtest/gtest.h>

#include "coupling/fluidScene.hpp"
#include "schemes/numerics.hpp"
#include "schemes/stepper.hpp"

namespace corpuscle::schemes {
namespace {

TEST(ModelName, isChosenAndRefusesWhatItCannotDo) {
    WrittenNumerics n("integrator: modelName\n");
    EXPECT_EQ(n.settled("modelName").scheme->traits().state, "modelName");
    Problems problems;
    n.facts.hasCells = true;
    check(n.settled("modelName"), n.settings, n.facts, problems);
    EXPECT_EQ(problems.count(), 1u);
}

// A disordered fluid in a periodic box conserves its momentum; if it moves uniformly, it continues to do so.
TEST(ModelName, steps) {
    const Index3 size{8, 8, 8};
    coupling::testing::FluidScene f(coupling::testing::still(size, 0.1), size, sph::testing::model("wendlandC2"), 1,
                                    0.3, MPI_COMM_SELF, particles::Precision::full);
    particles::ParticleStore& s = f.scene.store();
    const Vec3 U(0.02, -0.01, 0.03);
    for (std::size_t i = 0; i < s.size(); ++i) s.setVelocity(i, U), s.density[i] = 1;
    const auto stepper =
        WrittenNumerics("").settled("modelName").scheme->stepper({}, WrittenNumerics("").settings, f.scene);
    stepper->start();
    const double dt = stepper->limits(0).binding().seconds;
    EXPECT_GT(dt, 0);
    for (int k = 0; k < 5; ++k) stepper->advance(dt, dt);
    Vec3 momentum = Vec3::Zero();
    for (std::size_t i = 0; i < s.size(); ++i) momentum += s.velocity(i);
    EXPECT_LT((momentum / static_cast<double>(s.size()) - U).norm(), 1e-12);
    EXPECT_EQ(stepper->state().size(), stepper->stateSize());
}

}  // namespace
}  // namespace corpuscle::schemes
