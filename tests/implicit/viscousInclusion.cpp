// A ball of another viscosity, within a membrane without stiffness, in shear flow: inside, the strain rate is uniform,
//
//     E_in = 5/(2 lambda + 3) E,    lambda = mu_in/mu_out
// and the rotation that of the flow: Eshelby's inclusion (Proc. R. Soc. A 241 (1957) 376) for incompressible viscous
// media, also the inside of Taylor's drop (Proc. R. Soc. A 138 (1932) 41) with the tension left out. Lengths in
// spacings, density and viscosity outside 1.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "coupling/fluidScene.hpp"
#include "coupling/sphereScene.hpp"
#include "implicit/implicitStep.hpp"

using namespace corpuscle;
using namespace corpuscle::implicit;
using coupling::testing::FluidScene;
using particles::ParticleStore;

namespace {

constexpr double rate = 1e-6, stepStrain = 0.02, jitter = 0.1;  // Re below 1e-4
constexpr int layers = 3;

struct Inclusion {
    double strain, rotation;  // of the inside over those of the flow
};

// The membrane, which says how much of a particle lies inside; its volume is that of the ball.
coupling::Cells passive(double radius, double lambda, const Vec3& centre) {
    membrane::MembraneSettings laws;
    laws.bonds = coupling::testing::choice<membrane::BondLaw>(
        "{type: harmonic, k: 1e-15 N/m}");  // over mu rate a: 2e-9 and less
    auto mesh = membrane::testing::icosphere(radius < 6 ? 3 : 4);
    double volume = 0;
    for (const Index3& t : mesh.triangles)
        volume += mesh.nodes[static_cast<std::size_t>(t[0])].dot(
                      mesh.nodes[static_cast<std::size_t>(t[1])].cross(mesh.nodes[static_cast<std::size_t>(t[2])])) /
                  6;
    for (Vec3& x : mesh.nodes) x *= radius * std::cbrt(4 * std::numbers::pi / 3 / volume);
    coupling::CellType type{.name = "ball",
                            .laws = "ball",
                            .nodes = mesh.nodes,
                            .triangles = mesh.triangles,
                            .settings = laws,
                            .radius = radius,
                            .viscosityRatio = lambda};
    type.places.push_back({.centre = centre});
    return coupling::Cells({type});
}

// Periodic along the flow and the vorticity, walls six radii apart.
Inclusion measure(int radius, double lambda) {
    const int length = 6 * radius;
    const Index3 size{length, length, length + 2 * layers};
    const Vec3 centre(0.5 * length, 0.5 * length, layers + 0.5 * length);
    const auto flow = [&](const Vec3& x) { return Vec3(rate * (x[2] - centre[2]), 0, 0); };
    sph::FluidModel model = sph::testing::model("wendlandC2", "linear");
    model.viscosity = 1,
    model.soundSpeed = std::sqrt(2e4 * rate);  // what the first step compresses is below 1 % of the strain
    const double low = layers, high = layers + length;
    model.walls = boundary::testing::planes(2, low, high, flow({0, 0, low}), flow({0, 0, high}));

    auto all = coupling::testing::sheared(size, jitter, model.walls, flow);
    for (auto& p : all) p.viscosity = (p.x - centre).norm() < radius ? lambda : 1;
    ParticleStore::Optional fields;
    fields.viscosity = fields.side = true;
    FluidScene f(all, size, model, rate, 0, MPI_COMM_WORLD, particles::Precision::full, fields);
    f.scene.fluidBox.low[2] = low, f.scene.fluidBox.high[2] = high;
    f.scene.flow.shearRate = rate;
    f.scene.flow.velocity = flow;
    ParticleStore& store = f.scene.store();
    for (std::size_t i = 0; i < store.size(); ++i) store.side[i] = (store.position(i) - centre).norm() < radius ? 1 : 0;
    f.scene.cells = passive(radius, lambda, centre);
    f.scene.cells.placeAtStart(*f.scene.system);
    for (coupling::Cell& cell : f.scene.cells)
        for (std::size_t m = 0; m < cell.membrane.position.size(); ++m)
            cell.membrane.velocity[m] = flow(cell.membrane.position[m]);
    ImplicitStep::Options options;
    options.settings.step = stepStrain, options.settings.tolerance = 1e-4;
    options.shifting = 1;
    ImplicitStep::make(f.scene, options)->advance(stepStrain / rate);

    // Least squares of a linear velocity over what is well inside.
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    Eigen::Matrix<double, 4, 3> b = Eigen::Matrix<double, 4, 3>::Zero();
    const ParticleStore& s = f.scene.store();
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec3 d = s.position(i) - centre;
        if (d.norm() > 0.7 * radius) continue;
        const Eigen::Vector4d row(1, d[0], d[1], d[2]);
        A += row * row.transpose(), b += row * s.velocity(i).transpose();
    }
    MPI_Allreduce(MPI_IN_PLACE, A.data(), 16, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, b.data(), 12, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    const Mat3 slope = (A.ldlt().solve(b)).bottomRows<3>();  // of component j along axis i
    return {(slope(2, 0) + slope(0, 2)) / rate, (slope(2, 0) - slope(0, 2)) / rate};
}

// Errors are fractions of the flow's strain rate, or of the inside's where that is larger. What is left at eight
// spacings is the box: its walls and images change the rotation by the same 1 %, which does not depend on the
// resolution.
void compare(double lambda) {
    const double exact = 5 / (2 * lambda + 3), allowed = 0.03 * std::max(1.0, exact);
    for (const int radius : {4, 8}) {
        const Inclusion inside = measure(radius, lambda);
        std::printf("lambda %g, radius %d: strain rate %.4f (%.4f), rotation %.4f\n", lambda, radius, inside.strain,
                    exact, inside.rotation);
        EXPECT_NEAR(inside.strain, exact, allowed);
        EXPECT_NEAR(inside.rotation, 1, 0.025);
    }
}

TEST(ViscousInclusion, strainsAsItsViscosityLetsIt) {
    for (const double lambda : {1.0, 0.2, 5.0, 50.0}) compare(lambda);
}

}  // namespace
