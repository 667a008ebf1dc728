// Viscosity of the membrane: tension of homogeneous rates, power, rigid motions, broken triangles, the pressure of a
// growing sphere.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "membrane/membrane.hpp"
#include "membrane/surface.hpp"
#include "meshes.hpp"

namespace corpuscle::membrane {
namespace {

using testing::Mesh;
using Vectors = std::vector<Vec3>;

constexpr SurfaceViscosity law{0.7, 1.9};
constexpr SurfaceViscosity thinningLaw{0.7, 1.9, ShearThinning{0.25, 0.4}};

Vectors forces(const Network& network, const Vectors& x, const Vectors& v) {
    Vectors f(x.size(), Vec3::Zero());
    law.addForces(network, {x, v}, v, f);
    return f;
}

double power(const Vectors& f, const Vectors& v) {
    double sum = 0;
    for (std::size_t k = 0; k < f.size(); ++k) {
        sum -= f[k].dot(v[k]);
    }
    return sum;
}

template <class F>
Vectors velocities(const Vectors& x, F&& field) {
    Vectors v;
    for (const Vec3& p : x) {
        v.push_back(field(p));
    }
    return v;
}

struct MeshCase {
    const char* name;
    Mesh mesh;
    Vectors x;
};
std::vector<MeshCase> deformedMeshes() {
    std::vector<MeshCase> cases{{"regular", testing::icosphere(2), {}}, {"irregular", testing::irregular(2), {}}};
    for (MeshCase& c : cases) {
        c.x = testing::deformed(c.mesh.nodes, 0.3);
    }
    return cases;
}

Vectors anyVelocities(std::size_t n) {
    Vectors v(n, Vec3::Zero());
    testing::jitter(v, 1, 5);
    return v;
}

TEST(SurfaceViscosity, DissipatesTensionTimesRateInEveryHomogeneousFlowOfASheet) {
    const Mesh mesh = testing::hexagonalPatch(5);
    const Network network(mesh.nodes, mesh.triangles);
    Vectors x = mesh.nodes;  // stretched far from rest: only the present shape counts
    for (Vec3& p : x) {
        p = Vec3(1.4 * p.x() + 0.3 * p.y(), 0.8 * p.y(), 0);
    }
    const double area = 1.4 * 0.8 * 25 * testing::hexagonalCell;
    for (const auto& [name, xx, xy, yy] : {std::tuple{"growing", 0.3, 0.0, 0.3},
                                           {"one way", 0.5, 0.0, 0.0},
                                           {"pure shear", 0.4, 0.0, -0.4},
                                           {"any", 0.2, 0.7, -0.1}}) {
        const Vectors v = velocities(x, [&](const Vec3& p) { return Vec3(xx * p.x() + xy * p.y(), yy * p.y(), 0); });
        const double trace = xx + yy, square = xx * xx + yy * yy + 0.5 * xy * xy;
        const double expected = area * (2 * law.shear * square + (law.dilatation - law.shear) * trace * trace);
        EXPECT_NEAR(power(forces(network, x, v), v), expected, 1e-12 * expected) << name;
    }
}

// Carreau's law with the shear rate of the flow, whatever the shape of the triangles; dilatation does not reduce the
// viscosity.
TEST(SurfaceViscosity, ThinsWithTheRateOfShear) {
    const ShearThinning thinning = *thinningLaw.thinning;
    EXPECT_EQ(thinning.factor(0), 1);
    EXPECT_DOUBLE_EQ(thinning.factor(0.25), std::pow(2, -0.3));
    EXPECT_NEAR(thinning.factor(800) / thinning.factor(100), std::pow(8, -0.6), 1e-5);

    const Mesh mesh = testing::hexagonalPatch(5);
    const Network network(mesh.nodes, mesh.triangles);
    Vectors x = mesh.nodes;
    for (Vec3& p : x) {
        p = Vec3(1.4 * p.x() + 0.3 * p.y(), 0.8 * p.y(), 0);
    }
    const double area = 1.4 * 0.8 * 25 * testing::hexagonalCell;
    for (const auto& [xx, xy, yx, yy] :
         {std::array{0.0, 0.6, 0.0, 0.0}, std::array{0.3, 0.9, 0.2, -0.1}, std::array{0.2, 0.0, 0.0, 0.2}}) {
        const Vectors u =
            velocities(x, [&](const Vec3& p) { return Vec3(xx * p.x() + xy * p.y(), yx * p.x() + yy * p.y(), 0); });
        const double q2 = (xx - yy) * (xx - yy) + (xy + yx) * (xy + yx), trace = xx + yy;
        Vectors f(x.size(), Vec3::Zero());
        thinningLaw.addForces(network, {x, u}, u, f);
        const double viscosity = 0.7 * std::pow(1 + q2 / (0.25 * 0.25), -0.3),
                     expected = area * (viscosity * q2 + 1.9 * trace * trace);
        EXPECT_NEAR(power(f, u), expected, 1e-12 * expected);
    }
}

TEST(SurfaceViscosity, RigidMotionsFeelNothingAndTheWholeFeelsNoForceAndNoTorque) {
    for (const auto& [name, mesh, x] : deformedMeshes()) {
        const Network network(mesh.nodes, mesh.triangles);
        const Vec3 spin(0.3, -1.1, 0.6);
        const Vectors rigid = velocities(x, [&](const Vec3& p) -> Vec3 { return Vec3(1, 2, 3) + spin.cross(p); });
        for (const Vec3& f : forces(network, x, rigid)) {
            EXPECT_LT(f.norm(), 1e-12) << name;
        }
        const Vectors f = forces(network, x, anyVelocities(x.size()));
        Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
        double magnitude = 0;
        for (std::size_t k = 0; k < x.size(); ++k) {
            force += f[k], torque += x[k].cross(f[k]), magnitude += f[k].norm();
        }
        EXPECT_LT(force.norm() + torque.norm(), 1e-13 * magnitude) << name;
    }
}

// Half the dissipated power is a potential of the forces, so the damping matrix is symmetric; the power is positive.
TEST(SurfaceViscosity, IsSymmetricAndNeverFeedsEnergy) {
    for (const auto& [name, mesh, x] : deformedMeshes()) {
        const Network network(mesh.nodes, mesh.triangles);
        Vectors v = anyVelocities(x.size()), w = v;
        testing::jitter(w, 1, 6);
        const double vw = power(forces(network, x, v), w), wv = power(forces(network, x, w), v);
        EXPECT_NEAR(vw, wv, 1e-12 * std::abs(vw)) << name;
        EXPECT_GT(power(forces(network, x, v), v), 0) << name;
    }
}

// The matrix is computed from squares of rates, the forces from the metric: two independent forms of the same law. Both
// leave out holes.
TEST(SurfaceViscosity, DampingMatrixGivesTheForcesAndIsSymmetricAndSemiDefinite) {
    for (const auto& [name, mesh, x] : deformedMeshes()) {
        for (const SurfaceViscosity& viscosity :
             {law, SurfaceViscosity{0.7, 0}, SurfaceViscosity{0, 1.9}, thinningLaw}) {
            MembraneSettings settings;
            settings.viscosity = viscosity;
            Membrane membrane("cell", 1, mesh.nodes, mesh.triangles, settings, 1);
            membrane.position = x;
            membrane.velocity = velocities(x, [](const Vec3& p) { return Vec3(p.y(), 0.2 * p.x(), p.z() * p.z()); });
            membrane.breakBonds({{17, 1.2, Vec3::Zero()}, {40, 1.2, Vec3::Zero()}});
            AssembledStiffness damping(x.size());
            membrane.addDamping(damping);
            ASSERT_TRUE(damping.rankOne().empty()) << name;
            const Eigen::MatrixXd c(damping.sparse());
            EXPECT_EQ((c - c.transpose()).cwiseAbs().maxCoeff(), 0) << name;
            const Eigen::VectorXd eigenvalues =
                Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(c, Eigen::EigenvaluesOnly).eigenvalues();
            const double largest = eigenvalues[eigenvalues.size() - 1];
            EXPECT_GE(eigenvalues[0], -1e-12 * largest) << name;

            const auto times = [&](const Vectors& v) {
                return Eigen::VectorXd(c * Eigen::Map<const Eigen::VectorXd>(v.front().data(), c.cols()));
            };
            const Vectors v = anyVelocities(x.size());
            Vectors f(x.size(), Vec3::Zero());
            membrane.addViscousForces(v, f);
            const Eigen::Map<const Eigen::VectorXd> force(f.front().data(), c.cols());
            EXPECT_LT((times(v) + force).norm(), 1e-12 * force.norm()) << name;

            const Vec3 spin(0.3, -1.1, 0.6);
            const Vectors rigid = velocities(x, [&](const Vec3& p) -> Vec3 { return Vec3(1, 2, 3) + spin.cross(p); });
            EXPECT_LT(times(rigid).cwiseAbs().maxCoeff(), 1e-13 * largest) << name;
        }
    }
}

TEST(SurfaceViscosity, DampsNothingWhereItIsNotNamed) {
    const Mesh mesh = testing::icosphere(1);
    AssembledStiffness damping(mesh.nodes.size());
    Membrane("cell", 1, mesh.nodes, mesh.triangles, MembraneSettings{}, 1).addDamping(damping);
    EXPECT_EQ(damping.sparse().nonZeros(), 0);
}

// Tension 2 dilatation dR/dt / R, and Laplace's law: 2/R of it as pressure. The sum of radial forces is 4 pi R^2 times
// that.
TEST(SurfaceViscosity, GrowingSphereHasThePressureOfLaplacesLaw) {
    double error[2];
    for (const int level : {2, 3}) {
        const Mesh mesh = testing::icosphere(level);
        const Network network(mesh.nodes, mesh.triangles);
        constexpr double radius = 1.3, rate = 0.2;
        Vectors x = mesh.nodes, v = mesh.nodes;
        for (Vec3& p : x) {
            p *= radius;
        }
        for (Vec3& u : v) {
            u *= rate;
        }
        double inward = 0;
        const Vectors f = forces(network, x, v);
        for (std::size_t k = 0; k < x.size(); ++k) {
            inward -= f[k].dot(mesh.nodes[k]);
        }
        const double expected = 4 * std::numbers::pi * 4 * law.dilatation * rate;
        error[level - 2] = inward / expected - 1;
    }
    EXPECT_LT(std::abs(error[1]), 0.01);
    EXPECT_NEAR(error[0] / error[1], 4, 0.3) << "second order in the edge";
}

TEST(SurfaceViscosity, BrokenTrianglesHaveNone) {
    const Mesh mesh = testing::icosphere(1);
    Network network(mesh.nodes, mesh.triangles);
    const Vectors v = anyVelocities(mesh.nodes.size());
    const Vectors before = forces(network, mesh.nodes, v);
    network.breakBonds(std::array{0});
    const Vectors after = forces(network, mesh.nodes, v);
    const auto [a, b] = network.allBonds()[0].node;
    for (std::size_t k = 0; k < v.size(); ++k) {
        bool atHole = false;
        for (const int t : network.bondTriangles(0)) {
            atHole |= std::ranges::count(network.triangles()[t], static_cast<int>(k)) > 0;
        }
        EXPECT_EQ(before[k] != after[k], atHole) << k;
    }
    EXPECT_NE(before[a], after[a]);
    EXPECT_NE(before[b], after[b]);
}

TEST(SurfaceViscosity, JoinsTheForcesOfAMembraneThatNamesIt) {
    const Mesh mesh = testing::icosphere(1);
    MembraneSettings settings;
    Membrane plain("cell", 1, mesh.nodes, mesh.triangles, settings, 1);
    settings.viscosity = law;
    Membrane viscous("cell", 1, mesh.nodes, mesh.triangles, settings, 1);
    plain.velocity = viscous.velocity = anyVelocities(mesh.nodes.size());
    plain.computeForces();
    viscous.computeForces();
    const Vectors expected = forces(viscous.network(), viscous.position, viscous.velocity);
    EXPECT_GT(power(expected, viscous.velocity), 0);
    for (std::size_t k = 0; k < expected.size(); ++k) {
        EXPECT_EQ(plain.force[k], Vec3::Zero());
        EXPECT_EQ(viscous.force[k], expected[k]);
    }
}

}  // namespace
}  // namespace corpuscle::membrane
