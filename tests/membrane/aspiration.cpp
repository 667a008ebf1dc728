// Micropipette aspiration: the pipette's energies against differences, a flat sheet against Evans' relation, a surface
// of constant tension against Laplace's law.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/flatSheet.hpp"
#include "membrane/pipette.hpp"
#include "membrane/protocol.hpp"
#include "meshes.hpp"
#include "settingsText.hpp"

namespace corpuscle::membrane {
namespace {

// A conical sheet through the mouth, with nodes in the glass, on both sides of the glass and below.
TEST(Pipette, ForcesAndStiffnessAreTheDerivativesOfItsEnergies) {
    const geometry::TriangleMesh mesh = geometry::disc(2, 0.25);
    const Network network(mesh.nodes, mesh.triangles);
    std::vector<Vec3> x = mesh.nodes;
    for (Vec3& p : x) {
        p[2] = 1.55 - 1.15 * p.norm();
    }
    testing::jitter(x, 0.03, 4);
    const Pipette pipette{.radius = 1, .wall = 0.4, .mouth = 0, .contactPressure = 3, .depth = 0.1};
    for (const auto& term :
         {pipetteContact(network, pipette), pipetteSuction(network, network.stressFree(), pipette, 1.7)}) {
        std::vector<Vec3> f(x.size(), Vec3::Zero());
        term->addForces(x, f);
        AssembledStiffness stiffness(x.size());
        term->addStiffness(x, Definiteness::exact, stiffness);
        double largest = 0;
        for (const Vec3& v : f) {
            largest = std::max(largest, v.norm());
        }
        ASSERT_GT(largest, 1e-3);
        constexpr double h = 1e-6;
        for (std::size_t n = 0; n < x.size(); n += 3) {
            for (int k = 0; k < 3; ++k) {
                std::vector<Vec3> up = x, down = x;
                up[n][k] += h, down[n][k] -= h;
                EXPECT_NEAR(-(term->energy(up) - term->energy(down)) / (2 * h), f[n][k], 1e-7 * largest);
                std::vector<Vec3> fUp(x.size(), Vec3::Zero()), fDown = fUp;
                term->addForces(up, fUp), term->addForces(down, fDown);
                Eigen::VectorXd unit = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * x.size()));
                unit[static_cast<Eigen::Index>(3 * n) + k] = 1;
                const Eigen::VectorXd column = stiffness * unit;
                for (std::size_t m = 0; m < x.size(); ++m) {
                    const Vec3 change = (fDown[m] - fUp[m]) / (2 * h);
                    EXPECT_LT((change - column.segment<3>(static_cast<Eigen::Index>(3 * m))).norm(), 1e-5);
                }
            }
        }
    }
}

// Curvature of the sphere fitted to the nodes of a cap about the axis: rho^2 + z^2 = 2 z z_c + R^2 - z_c^2.
double capCurvature(const std::vector<Vec3>& x, double side, double reach) {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (const Vec3& p : x) {
        if (side * p[2] > 0 && p.head<2>().norm() < reach) {
            const Eigen::Vector2d row(2 * p[2], 1);
            normal += row * row.transpose();
            right += p.squaredNorm() * row;
        }
    }
    const Eigen::Vector2d fit = normal.ldlt().solve(right);
    return 1 / std::sqrt(fit[1] + fit[0] * fit[0]);
}

// A drop with the tension T = K (A/A0 - 1), drawn into a pipette by up to half a bore: P = T (sum of curvatures of the
// cap less that of the body), from Laplace's law for the cap and for the body, which have the same inner pressure.
TEST(Aspiration, OfADropFollowsLaplace) {
    const auto aspiration =
        testing::chosen<Protocol>("{type: aspiration, radius: 0.6 m, wall: 0.4 m, pressures: [0.8 Pa, 1.6 Pa]}");
    const testing::Mesh sphere = testing::icosphere(3);
    Membrane drop(
        "drop", 1, sphere.nodes, sphere.triangles,
        testing::parsed<MembraneSettings>("{triangles: {type: neoHookean, Gs: 0.02 N/m}, area: {global: 10 N/m, "
                                          "rest: 11.4 m^2}, volume: {modulus: 1e4 Pa}}"),
        1);
    double length = 0;
    for (int stage = 0; stage < aspiration->stages(); ++stage) {
        ASSERT_TRUE(
            findEquilibrium(drop, aspiration->apply(stage, drop), {.tolerance = 1e-6, .forceScale = 1}).converged);
        const std::vector<double> row = aspiration->measure(stage, drop);
        EXPECT_GT(row[1], length);
        length = row[1];
        const double tension = 10 * (drop.area() / 11.4 - 1);
        const double jump = capCurvature(drop.position, 1, 0.35) - capCurvature(drop.position, -1, 0.35);
        EXPECT_NEAR(2 * tension * jump, row[0], 0.05 * row[0]) << "length " << length;
    }
}

// A second method for the flat sheet: the equations of an axisymmetric membrane without bending, with a neo-Hookean law
// and an area modulus K, from a hemispherical cap of uniform tension P R/2 down the bore, round the lip and out to the
// border, where the tension is zero:
//     dT1/ds = -(T1 - T2) cos(psi)/rho,   dr0/ds = 1/l1,   l2 = rho/r0,   T1(l1, l2) known
// with the arc length s, the distance rho from the axis, and r0, this distance at rest.
struct AxisymmetricSheet {
    double G, K, R, lip, border;

    double tension(double along, double across) const {
        return G * (along - 1 / (along * along * along * across * across)) / across + K * (along * across - 1);
    }
    double stretch(double T, double across) const {  // l1
        return root([&](double l) { return tension(l, across) - T; }, 0.2, 5);
    }
    static double root(const std::function<double(double)>& rising, double low, double high) {
        for (int k = 0; k < 60; ++k) {
            const double middle = 0.5 * (low + high);
            (rising(middle) < 0 ? low : high) = middle;
        }
        return low;
    }
    // Minus the tension at the border, where the sheet covers the bore over this length.
    double excess(double P, double covered) const {
        constexpr int parts = 300;
        double T = 0.5 * P * R, rho = R;
        double r0 = std::numbers::sqrt2 * R / root([&](double l) { return tension(l, l) - T; }, 1, 2);
        const auto go = [&](double ds, double slope) {
            const double across = rho / r0, along = stretch(T, across);
            T -= (tension(along, across) - tension(across, along)) * slope / rho * ds;
            r0 += ds / along, rho += slope * ds;
        };
        for (int k = 0; k < parts; ++k) {
            go(covered / parts, 0);
        }
        for (int k = 0; k < parts; ++k) {
            go(0.5 * std::numbers::pi * lip / parts, std::sin(0.5 * std::numbers::pi * (k + 0.5) / parts));
        }
        while (r0 < border) {
            go(0.01, 1);
        }
        return -T;
    }
    double length(double P) const {  // L
        return R + lip + root([&](double covered) { return excess(P, covered); }, 0, 5 * R);
    }
};

TEST(Aspiration, OfAFlatSheetIsThatOfAnAxisymmetricOne) {
    // Evans' relation holds for a large sheet of constant area without a lip.
    const AxisymmetricSheet kept{.G = 1, .K = 1e4, .R = 1, .lip = 1e-6, .border = 20};
    EXPECT_NEAR(kept.length(4), 1.8467, 0.02);  // 2 L - 1 + ln(2 L) = 4

    const auto aspiration = testing::chosen<Protocol>(
        "{type: aspiration, radius: 1 m, wall: 0.6 m, pressures: [0.7 Pa, 1.4 Pa, 2 Pa, 2.5 Pa, 3 Pa]}");
    const geometry::TriangleMesh mesh = geometry::disc(3.5, 0.19);
    Membrane sheet(
        "sheet", 1, mesh.nodes, mesh.triangles,
        testing::parsed<MembraneSettings>("{triangles: {type: neoHookean, Gs: 1 N/m}, area: {local: 20 N/m}, "
                                          "bending: {type: helfrich, kappa: 0.02 J}}"),
        1);
    const AxisymmetricSheet second{.G = 1, .K = 20, .R = 1, .lip = 0.3, .border = 3.5};
    for (int stage = 0; stage < aspiration->stages(); ++stage) {
        ASSERT_TRUE(
            findEquilibrium(sheet, aspiration->apply(stage, sheet), {.tolerance = 1e-6, .forceScale = 1}).converged);
        const std::vector<double> row = aspiration->measure(stage, sheet);
        if (row[0] > 1.7) {
            EXPECT_NEAR(row[2], second.length(row[0]), 0.06 * row[2]) << row[0] << " Pa";
        }
    }
}

TEST(Aspiration, RefusesWhatDoesNotFit) {
    const testing::Mesh sphere = testing::icosphere(1);
    Membrane cell("cell", 1, sphere.nodes, sphere.triangles,
                  testing::parsed<MembraneSettings>("{bonds: {type: harmonic, k: 2 N/m}}"), 1);
    EXPECT_THROW(
        testing::chosen<Protocol>("{type: aspiration, radius: 1.1 m, wall: 0.9 m, pressures: [1 Pa]}")->apply(0, cell),
        Failure)
        << "wider than the cell";
    EXPECT_THROW(
        testing::chosen<Protocol>("{type: aspiration, radius: 0.5 m, wall: 0.1 m, pressures: [1 Pa]}")->apply(0, cell),
        Failure)
        << "thinner than an edge";
    EXPECT_THROW(testing::chosen<Protocol>("{type: aspiration, radius: 0.5 m, wall: 0.6 m, pressures: []}"), CaseError);
}

}  // namespace
}  // namespace corpuscle::membrane
