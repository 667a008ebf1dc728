// A cell that nothing deforms turns as a rigid body, by a fifth of a radian in a step. It must have its size at the end
// of every step, however long the step was: the excess of size from a step along the chord (coupling/arc.hpp) would
// have to be undone when the next step has another length. Lengths in spacings, density 1.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "coupling/sphereScene.hpp"
#include "implicit/implicitStep.hpp"

using namespace corpuscle;
using coupling::testing::SphereScene;
using implicit::ImplicitStep;

namespace {

constexpr double rate = 0.01;  // [1/s]
const Vec3 centre(5.1, 4.9, 5);

// A stiff spherical membrane in a column of fluid that rotates rigidly about z, with fluid at rest near the faces of
// the box.
coupling::Scene turningSphere() {
    coupling::Scene scene =
        SphereScene({10, 10, 6}, {centre}, true).immersedScene(rate, [](const Vec3& d) { return d; });
    sph::FluidModel model = sph::testing::model("wendlandC2");
    model.viscosity = 1e-3;
    scene.forces = std::make_unique<sph::FluidForces>(model, *scene.system);
    const auto velocity = [](const Vec3& x) {
        const Vec3 d(x[0] - centre[0], x[1] - centre[1], 0);
        const double t = std::clamp((d.norm() - 2.8) / 2, 0.0, 1.0);
        return Vec3(rate * (1 - t * t * (3 - 2 * t)) * Vec3::UnitZ().cross(d));
    };
    particles::ParticleStore& s = scene.store();
    for (std::size_t i = 0; i < s.size(); ++i) s.setVelocity(i, velocity(s.position(i)));
    for (coupling::Cell& cell : scene.cells)
        for (std::size_t m = 0; m < cell.membrane.position.size(); ++m)
            cell.membrane.velocity[m] = velocity(cell.membrane.position[m]);
    return scene;
}

// Width of the nodes across the axis over that along it.
double widthOf(const std::vector<Vec3>& nodes) {
    Vec3 mean = Vec3::Zero(), square = Vec3::Zero();
    for (const Vec3& x : nodes) mean += x / static_cast<double>(nodes.size());
    for (const Vec3& x : nodes) square += (x - mean).cwiseAbs2();
    return std::sqrt((square[0] + square[1]) / (2 * square[2]));
}

}  // namespace

TEST(TurningCell, hasItsSizeAtTheEndOfEveryStep) {
    coupling::Scene scene = turningSphere();
    ImplicitStep::Options options;
    options.settings = {.step = 1, .tolerance = 1e-8, .error = 1, .bondStrain = 1};
    const auto step = ImplicitStep::make(scene, options);
    double turned = 0;
    for (const double angle : {0.2, 0.2, 0.2, 0.05, 0.2, 0.1, 0.2}) {
        step->advance(angle / rate);
        turned += angle;
        for (const coupling::Cell& cell : scene.cells) {
            const std::vector<Vec3>&now = cell.membrane.position, &rest = cell.membrane.initialPosition();
            EXPECT_NEAR(widthOf(now) / widthOf(rest), 1, 1.2e-3) << "at " << turned;  // on the chord 0.01
            const Vec3 before = rest[0] - centre, after = now[0] - coupling::middleOf(cell);
            const double found = std::atan2(before.cross(after)[2], before.head<2>().dot(after.head<2>()));
            EXPECT_NEAR(found, turned, 0.05) << "the fluid turns it";
        }
    }
    EXPECT_EQ(step->statistics.halvings, 0);
}
