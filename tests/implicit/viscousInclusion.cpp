// A ball of another viscosity, within a membrane without stiffness, in shear flow: inside, the strain rate is uniform,
//
//     E_in = 5/(2 lambda + 3) E,    lambda = mu_in/mu_out
// and the rotation that of the flow: Eshelby's inclusion (Proc. R. Soc. A 241 (1957) 376) for incompressible viscous
// media, also the inside of Taylor's drop (Proc. R. Soc. A 138 (1932) 41) with the tension left out. In an oblate
// spheroid of axes a, a, c, its axis along the gradient, the shear strain rate and the rotation are
//
//     e = E/(1 + 2 (lambda - 1) S),   w = W - 2 (lambda - 1) P e,   S, P = S_1313, Pi_1313 of Eshelby (Mura,
//                                     Micromechanics of Defects in Solids, 2nd ed., 11.21 and 11.40)
// for lambda without bound Jeffery's, w = 2 r^2/(1 + r^2) W with r = c/a. Lengths in spacings, density and viscosity
// outside 1.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "coupling/fluidScene.hpp"
#include "coupling/sphereScene.hpp"
#include "implicit/implicitStep.hpp"
#include "membrane/surface.hpp"

using namespace corpuscle;
using namespace corpuscle::implicit;
using coupling::testing::FluidScene;
using particles::ParticleStore;

namespace {

constexpr double rate = 1e-6, stepStrain = 0.02, jitter = 0.1;  // Re below 1e-4
constexpr int layers = 3;

struct Inclusion {
    double strain, rotation;  // of the inside, over those of the flow
};

// within: from particles well inside; mean: from the velocities of the membrane.
struct Measured {
    Inclusion within, mean;
};

struct Spheroid {
    double a, ratio;  // of the axes, c/a
    bool holds(const Vec3& d, double scale = 1) const { return Vec3(d[0], d[1], d[2] / ratio).norm() < scale * a; }
    Inclusion exact(double lambda) const {
        if (ratio == 1) return {5 / (2 * lambda + 3), 1};
        const double flatness = 1 - ratio * ratio,
                     I1 = 2 * std::numbers::pi * ratio / std::pow(flatness, 1.5) *
                          (std::acos(ratio) - ratio * std::sqrt(flatness)),
                     I3 = 4 * std::numbers::pi - 2 * I1, P = (I3 - I1) / (8 * std::numbers::pi),
                     S = P * (1 + ratio * ratio) / flatness, strain = 1 / (1 + 2 * (lambda - 1) * S);
        return {strain, 1 - 2 * (lambda - 1) * P * strain};
    }
};

// The membrane, which determines how much of a particle lies inside; it encloses the volume of the shape.
coupling::Cells passive(const Spheroid& shape, double lambda, const Vec3& centre) {
    membrane::MembraneSettings laws;
    laws.bonds = coupling::testing::choice<membrane::BondLaw>(
        "{type: harmonic, k: 1e-15 N/m}");  // over mu rate a: 2e-9 and less
    auto mesh = membrane::testing::icosphere(shape.a < 6 ? 3 : 4);
    double volume = 0;
    for (const Index3& t : mesh.triangles)
        volume += mesh.nodes[static_cast<std::size_t>(t[0])].dot(
                      mesh.nodes[static_cast<std::size_t>(t[1])].cross(mesh.nodes[static_cast<std::size_t>(t[2])])) /
                  6;
    const double scale = shape.a * std::cbrt(4 * std::numbers::pi / 3 / volume);
    for (Vec3& x : mesh.nodes) x = scale * Vec3(x[0], x[1], shape.ratio * x[2]);
    coupling::CellType type{.name = "ball",
                            .laws = "ball",
                            .nodes = mesh.nodes,
                            .triangles = mesh.triangles,
                            .settings = laws,
                            .radius = shape.a,
                            .viscosityRatio = lambda};
    type.places.push_back({.centre = centre});
    return coupling::Cells({type});
}

// Periodic along the flow and the vorticity, walls six radii apart.
Measured measure(const Spheroid& shape, double lambda) {
    const int length = static_cast<int>(std::lround(6 * shape.a));
    const Index3 size{length, length, length + 2 * layers};
    const Vec3 centre(0.5 * length, 0.5 * length, layers + 0.5 * length);
    const auto flow = [&](const Vec3& x) { return Vec3(rate * (x[2] - centre[2]), 0, 0); };
    sph::FluidModel model = sph::testing::model("wendlandC2", "linear");
    model.viscosity = 1,
    model.soundSpeed = std::sqrt(2e4 * rate);  // compression in the first step is below 1 % of the strain
    const double low = layers, high = layers + length;
    model.walls = boundary::testing::planes(2, low, high, flow({0, 0, low}), flow({0, 0, high}));

    auto all = coupling::testing::sheared(size, jitter, model.walls, flow);
    for (auto& p : all) p.viscosity = shape.holds(p.x - centre) ? lambda : 1;
    ParticleStore::Optional fields;
    fields.viscosity = fields.side = true;
    FluidScene f(all, size, model, rate, 0, MPI_COMM_WORLD, particles::Precision::full, fields);
    f.scene.fluidBox.low[2] = low, f.scene.fluidBox.high[2] = high;
    f.scene.flow.shearRate = rate;
    f.scene.flow.velocity = flow;
    ParticleStore& store = f.scene.store();
    for (std::size_t i = 0; i < store.size(); ++i) store.side[i] = shape.holds(store.position(i) - centre) ? 1 : 0;
    f.scene.cells = passive(shape, lambda, centre);
    f.scene.cells.placeAtStart(*f.scene.system);
    for (coupling::Cell& cell : f.scene.cells)
        for (std::size_t m = 0; m < cell.membrane.position.size(); ++m)
            cell.membrane.velocity[m] = flow(cell.membrane.position[m]);
    ImplicitStep::Options options;
    options.settings.step = stepStrain, options.settings.tolerance = 1e-4;
    options.shifting = 1;
    ImplicitStep::make(f.scene, options)->advance(stepStrain / rate);

    // Least squares fit of a linear velocity to the particles well inside.
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    Eigen::Matrix<double, 4, 3> b = Eigen::Matrix<double, 4, 3>::Zero();
    const ParticleStore& s = f.scene.store();
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec3 d = s.position(i) - centre;
        if (!shape.holds(d, 0.7)) continue;
        const Eigen::Vector4d row(1, d[0], d[1], d[2]);
        A += row * row.transpose(), b += row * s.velocity(i).transpose();
    }
    MPI_Allreduce(MPI_IN_PLACE, A.data(), 16, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, b.data(), 12, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    const Mat3 within = (A.ldlt().solve(b)).bottomRows<3>();  // of component j along axis i

    // The mean gradient inside, from the velocities of the membrane: 1/V sum A u^T.
    Mat3 mean = Mat3::Zero();
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    for (const coupling::Cell& cell : f.scene.cells) {
        if (!cell.isOwnedBy(rank)) continue;
        const auto& x = cell.membrane.position;
        const auto areas = membrane::volumeGradient(x, cell.membrane.network().triangles());
        double volume = 0;
        for (std::size_t m = 0; m < x.size(); ++m) volume += areas[m].dot(x[m] - x[0]) / 3;
        for (std::size_t m = 0; m < x.size(); ++m) mean += areas[m] * cell.membrane.velocity[m].transpose() / volume;
    }
    MPI_Allreduce(MPI_IN_PLACE, mean.data(), 9, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    const auto ofShear = [](const Mat3& slope) {  // of component j along axis i
        return Inclusion{(slope(2, 0) + slope(0, 2)) / rate, (slope(2, 0) - slope(0, 2)) / rate};
    };
    return {ofShear(within), ofShear(mean)};
}

void compare(const char* what, const Inclusion& found, const Inclusion& exact, const Inclusion& allowed) {
    std::printf("%s: strain rate %.4f (%.4f), rotation %.4f (%.4f)\n", what, found.strain, exact.strain, found.rotation,
                exact.rotation);
    EXPECT_NEAR(found.strain, exact.strain, allowed.strain) << what;
    EXPECT_NEAR(found.rotation, exact.rotation, allowed.rotation) << what;
}

// Errors are fractions of the flow's strain rate, or of the inside's where that is larger. The error that remains at a
// = 8 spacings is due to the finite box: its walls and images change the rotation by 1 %, independently of the
// resolution.
TEST(ViscousInclusion, strainsAsItsViscosityLetsIt) {
    for (const double lambda : {1.0, 0.2, 5.0, 50.0})
        for (const double a : {4.0, 8.0}) {
            const Spheroid ball{a, 1};
            const Inclusion exact = ball.exact(lambda);
            compare(fmt::format("ball, lambda {}, a {}", lambda, a).c_str(), measure(ball, lambda).within, exact,
                    {0.03 * std::max(1.0, exact.strain), 0.025});
        }
}

// The disc is 4.8 spacings thick, and thinner than a spacing at its rim: the mean over all of it is compared, since the
// velocity in its few layers is not linear.
TEST(ViscousInclusion, aThinSpheroidTurnsAsItsViscosityLetsIt) {
    const Spheroid disc{8, 0.3};
    EXPECT_NEAR(disc.exact(1e9).rotation, 2 * 0.3 * 0.3 / (1 + 0.3 * 0.3), 1e-6);
    for (const double lambda : {0.2, 5.0}) {
        const Inclusion exact = disc.exact(lambda);
        compare(fmt::format("disc, lambda {}", lambda).c_str(), measure(disc, lambda).mean, exact,
                {0.08 * exact.strain, 0.06 * exact.rotation});
    }
}

}  // namespace
