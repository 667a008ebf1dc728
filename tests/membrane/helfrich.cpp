// Helfrich bending against the energies of sphere, cylinder and red cell; errors and orders of convergence on regular
// and irregular meshes.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "core/error.hpp"
#include "geometry/kuchelFackerell.hpp"
#include "geometry/mesher.hpp"
#include "membrane/dihedralBending.hpp"
#include "membrane/helfrichBending.hpp"
#include "membrane/helfrichTerm.hpp"
#include "membrane/surface.hpp"
#include "meshes.hpp"

namespace corpuscle::membrane {
namespace {

using testing::Mesh;

constexpr double pi = std::numbers::pi, sphereEnergy = 8 * pi;  // over kappa, c0 = 0

double energyOf(const Mesh& mesh, double c0 = 0, std::optional<AreaDifference> difference = {}) {
    Network network(mesh.nodes, mesh.triangles);
    HelfrichBending law;
    law.kappa = 1;
    law.spontaneousCurvature = c0;
    law.areaDifference = difference;
    return law.makeTerm(network, {})->energy(mesh.nodes);
}

// An icosphere with nodes displaced along the sphere by up to `amplitude` edges.
Mesh irregularSphere(int level, double amplitude) {
    Mesh mesh = testing::icosphere(level);
    testing::jitter(mesh.nodes, amplitude * 1.1 / (1 << level), 7);
    for (Vec3& x : mesh.nodes) {
        x.normalize();
    }
    return mesh;
}

// 2 M_v^2/A_v with a third of each triangle for A_v.
double energyByThirds(const Mesh& mesh) {
    Network network(mesh.nodes, mesh.triangles);
    network.useHinges();
    std::vector<double> integral(mesh.nodes.size(), 0.0), area = integral;
    for (const Hinge& hinge : network.hinges()) {
        for (int k = 0; k < 2; ++k) {
            integral[hinge.node[k]] += 0.25 * network.allBonds()[hinge.number].rest * hinge.rest;
        }
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const int node : mesh.triangles[t]) {
            area[node] += network.restAreas()[t] / 3;
        }
    }
    double sum = 0;
    for (std::size_t v = 0; v < area.size(); ++v) {
        sum += 2 * integral[v] * integral[v] / area[v];
    }
    return sum;
}

// Levels 2 to 5: 162, 642, 2562, 10242 nodes. The error is that of the table in docs/theory/membrane.md.
TEST(Helfrich, SphereConvergesWithTheSquareOfTheEdge) {
    double before = 0;
    for (int level = 2; level <= 5; ++level) {
        const double error = energyOf(testing::icosphere(level)) / sphereEnergy - 1;
        RecordProperty("icosphere " + std::to_string(level), std::to_string(error));
        EXPECT_NEAR(error, 0.0064 / (1 << (2 * (level - 2))), 0.0001);
        if (level > 2) {
            EXPECT_GT(std::log2(before / error), 1.98);
        }
        before = error;
    }
}

TEST(Helfrich, IrregularSphere) {
    double before = 0;
    for (int level = 2; level <= 5; ++level) {
        const Mesh mesh = irregularSphere(level, 0.2);
        const double error = energyOf(mesh) / sphereEnergy - 1;
        RecordProperty("jitter 0.2 " + std::to_string(level), std::to_string(error));
        if (level > 2) {
            // an error of 1e-4 from obtuse triangles remains
            EXPECT_GT(std::log2(before / error), level < 5 ? 1.7 : 1.2);
        }
        before = error;
    }
    EXPECT_LT(before, 3e-4);
    EXPECT_GT(energyByThirds(irregularSphere(5, 0.2)) / sphereEnergy - 1, 3 * before);

    // With one triangle in six obtuse, the error stays at 0.16 %; with a third of each triangle as node area, at 0.3 %.
    const Mesh worse = irregularSphere(5, 0.3);
    EXPECT_LT(energyOf(worse) / sphereEnergy - 1, 0.002);
    EXPECT_GT(energyByThirds(worse) / sphereEnergy - 1, 0.003);
}

// The dihedral law would have 8 pi kappa/3 on a regular lattice, and stays 3.4 % above it on an icosphere; Helfrich's
// has 8 pi kappa.
TEST(Helfrich, TheDihedralLawHasAThirdOfTheSpheresEnergy) {
    for (const int level : {3, 4, 5}) {
        const Mesh mesh = testing::icosphere(level);
        Network network(mesh.nodes, mesh.triangles);
        network.useHinges();
        double springs = 0;
        for (const Hinge& hinge : network.hinges()) {
            springs += Harmonic{DihedralBending::springPerModulus()}.energy(hinge.rest, 0);
        }
        EXPECT_NEAR(springs / (sphereEnergy / 3), 1.035, 0.006);
        EXPECT_NEAR(energyOf(mesh) / sphereEnergy, 1, 0.002);
    }
}

TEST(Helfrich, SphereWithSpontaneousCurvature) {
    const Mesh mesh = irregularSphere(4, 0.2);
    for (const double c0 : {-1.0, 1.0, 3.0}) {
        EXPECT_NEAR(energyOf(mesh, c0) / (2 * pi * (2 - c0) * (2 - c0)), 1, 0.006) << c0;
    }
    EXPECT_LT(energyOf(mesh, 2), 1e-3 * sphereEnergy);
}

TEST(Helfrich, AreaDifferenceOfASphere) {
    const Mesh mesh = irregularSphere(4, 0.2);
    const double bare = energyOf(mesh), alpha = 0.6;
    const auto difference = [&](double m0) {
        return (energyOf(mesh, 0, AreaDifference{.ratio = alpha, .reduced = m0}) - bare) / (8 * pi * pi * alpha);
    };
    EXPECT_NEAR(difference(0), 1, 2e-3);
    EXPECT_NEAR(difference(1), 0, 1e-6);
    EXPECT_NEAR(difference(3), 4, 8e-3);

    // absolute: 2 D Int H dA of a sphere of radius R0 is 8 pi D R0.
    double area = 0;
    for (const Index3& t : mesh.triangles) {
        area += areaVector(mesh.nodes, t).norm();
    }
    const double D = 0.01, R0 = std::sqrt(area / (4 * pi));
    const AreaDifference absolute{.ratio = alpha, .absolute = 1.3 * 8 * pi * D * R0, .thickness = D};
    EXPECT_NEAR(energyOf(mesh, 0, absolute), energyOf(mesh, 0, AreaDifference{.ratio = alpha, .reduced = 1.3}), 1e-9);
}

// A piece of a flat lattice rolled up to a cylinder; `axis` is the angle between the lattice and the cylinder's axis.
std::vector<Vec3> rolled(const std::vector<Vec3>& flat, double radius, double axis) {
    std::vector<Vec3> x;
    for (const Vec3& p : flat) {
        const double along = p.x() * std::cos(axis) + p.y() * std::sin(axis),
                     arc = p.y() * std::cos(axis) - p.x() * std::sin(axis);
        x.emplace_back(along, radius * std::sin(arc / radius), radius * std::cos(arc / radius));
    }
    return x;
}

// E/A = kappa/(2 R^2) in the bulk. Nodes of a rim have no energy, so that (n - 1)^2 of (n + 1)^2 nodes count.
TEST(Helfrich, CylinderAndRim) {
    constexpr double radius = 200;
    for (const double axis : {0.0, 0.3, pi / 2}) {
        const Mesh flat = testing::hexagonalPatch(6);
        Mesh mesh = flat;
        mesh.nodes = rolled(flat.nodes, radius, axis);
        EXPECT_NEAR(energyOf(mesh) * 2 * radius * radius / (25 * testing::hexagonalCell), 1, 1e-4) << axis;
    }
}

// Total area of the nodes that have energy, from the energies with c0, with -c0 and without spontaneous curvature.
double countedArea(const Mesh& mesh, double c0) {
    return (energyOf(mesh, c0) + energyOf(mesh, -c0) - 2 * energyOf(mesh)) / (c0 * c0);
}

// The edge is 1/400 of the radius: the remaining error is not due to the edge length.
TEST(Helfrich, IrregularCylinderKeepsAnError) {
    constexpr double radius = 400;
    for (const double amplitude : {0.0, 0.1, 0.2}) {
        Mesh mesh = testing::hexagonalPatch(60);
        std::mt19937 random(5);
        std::uniform_real_distribution<double> shift(-amplitude, amplitude);
        for (Vec3& x : mesh.nodes) {
            x += Vec3(shift(random), shift(random), 0);
        }
        mesh.nodes = rolled(mesh.nodes, radius, 0.3);
        const double ratio = energyOf(mesh) * 2 * radius * radius / countedArea(mesh, 1 / radius);
        RecordProperty("jitter " + std::to_string(amplitude), std::to_string(ratio - 1));
        EXPECT_NEAR(ratio - 1, amplitude == 0 ? 0 : amplitude == 0.1 ? 6e-4 : 2.7e-3, 2e-4 * (1 + 10 * amplitude));
    }
}

// 1.9067 x 8 pi kappa: analytic, by quadrature of the profile (grade: certain).
constexpr double redCell = 1.9067 * sphereEnergy;

geometry::KuchelFackerell redCellShape() {
    geometry::KuchelFackerell shape;
    shape.d = 8, shape.h = 2.12, shape.b = 1;
    return shape;
}

TEST(Helfrich, RedCellOfTheMesher) {
    for (const auto& [edge, bound] : {std::pair{0.8, 0.003}, {0.4, 0.0015}, {0.25, 0.0006}}) {
        const geometry::TriangleMesh mesh = geometry::meshSurface(redCellShape(), edge);
        const double error = energyOf({mesh.nodes, mesh.triangles}) / redCell - 1;
        RecordProperty("edge " + std::to_string(edge), std::to_string(error));
        EXPECT_LT(std::abs(error), bound) << edge;
    }
}

// Icospheres projected along rays onto the red cell have a third of their triangles obtuse. If the nodes are disordered
// as well, an error of the energy remains.
TEST(Helfrich, RedCellOnDistortedMeshes) {
    const geometry::KuchelFackerell shape = redCellShape();
    const auto onto = [&](Mesh mesh) {
        for (Vec3& x : mesh.nodes) {
            const auto p = shape.profile(std::acos(x.z() / x.norm()));
            const double r = std::hypot(x.x(), x.y());
            x = r > 0 ? Vec3(p.rho * x.x() / r, p.rho * x.y() / r, p.z) : Vec3(0, 0, p.z);
        }
        return mesh;
    };
    for (int level = 3; level <= 5; ++level) {
        const double smooth = energyOf(onto(testing::icosphere(level))) / redCell - 1;
        const double disordered = energyOf(onto(irregularSphere(level, 0.2))) / redCell - 1;
        RecordProperty("level " + std::to_string(level), std::to_string(smooth) + " " + std::to_string(disordered));
        EXPECT_LT(std::abs(smooth), level == 3 ? 0.004 : 0.0004) << level;
        EXPECT_NEAR(disordered, 0.02, 0.012) << level;
    }
}

// On a flat sheet the stiffness has no geometric part: its largest eigenvalue is below the bound, by less than a factor
// of 3.
TEST(Helfrich, MaxStiffnessBoundsTheStiffness) {
    Mesh mesh = testing::hexagonalPatch(7);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> shift(-0.15, 0.15);
    for (Vec3& x : mesh.nodes) {
        x += Vec3(shift(random), shift(random), 0);
    }
    Network network(mesh.nodes, mesh.triangles);
    HelfrichBending law;
    law.kappa = 2;
    const auto term = law.makeTerm(network, {});
    AssembledStiffness stiffness(mesh.nodes.size());
    term->addStiffness(mesh.nodes, Definiteness::exact, stiffness);
    const double eigenvalue =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(stiffness.sparse())).eigenvalues().maxCoeff();
    EXPECT_LE(eigenvalue, term->maxStiffness(mesh.nodes));
    EXPECT_GE(3 * eigenvalue, term->maxStiffness(mesh.nodes));
}

// The shares of a triangle's nodes are positive and add up to its area; where angles are moderate they are Voronoi
// areas.
TEST(Helfrich, SharesOfATriangle) {
    for (const Vec3& apex : {Vec3(0.5, 0.8, 0), Vec3(0.6, 0.3, 0), Vec3(-3, 0.2, 0), Vec3(0.3, 1e-6, 0)}) {
        const std::array<Vec3, 3> x{Vec3(0, 0, 0), Vec3(1, 0, 0), apex};
        double sum = 0;
        for (int k = 0; k < 3; ++k) {
            const double share = NodeArea::at({x[k], x[(k + 1) % 3], x[(k + 2) % 3]}).value;
            EXPECT_GT(share, 0);
            sum += share;
        }
        EXPECT_NEAR(sum, 0.5 * apex.y(), 1e-12 * apex.y());
    }
    // Isosceles, base 1, height h, circumcentre c above the base.
    const double h = 0.8, c = (h * h - 0.25) / (2 * h);
    const double base = c / 4 + (h - c) / 8;  // triangles (node, middle of base, c) and (node, c, middle of side)
    EXPECT_NEAR(NodeArea::at({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, h, 0)}).value, base, 0.01 * base);
}

TEST(Helfrich, AreaDifferenceNeedsAClosedMesh) {
    HelfrichBending law;
    law.kappa = 1;
    law.areaDifference = AreaDifference{.ratio = 1, .reduced = 1.2};
    const Mesh patch = testing::hexagonalPatch(3), sphere = testing::icosphere(2);
    Network open(patch.nodes, patch.triangles);
    EXPECT_THROW(law.makeTerm(open, {}), Failure);

    Network closed(sphere.nodes, sphere.triangles), plain(sphere.nodes, sphere.triangles);
    const auto term = law.makeTerm(closed, {});
    law.areaDifference.reset();
    const auto bare = law.makeTerm(plain, {});
    EXPECT_GT(term->energy(sphere.nodes), bare->energy(sphere.nodes) + 1);
    for (Network* network : {&closed, &plain}) {
        network->breakBonds(std::vector<int>{12});
    }
    EXPECT_EQ(term->energy(sphere.nodes), bare->energy(sphere.nodes));
    EXPECT_LT(term->energy(sphere.nodes), 0.99 * sphereEnergy);  // four rim nodes
}

}  // namespace
}  // namespace corpuscle::membrane
