// Equilibria against closed forms, virtual work, and their own definition.
#include "membrane/equilibrium.hpp"

#include <gtest/gtest.h>

#include "core/registry.hpp"
#include "meshes.hpp"

namespace corpuscle::membrane {
namespace {

MembraneSettings springs(const std::string& bending = "") {
    Problems problems;
    const auto settings = read<MembraneSettings>(
        parseValue("{bonds: {type: harmonic, k: 2 N/m}" + bending + "}", "membrane", problems), problems);
    problems.throwIfAny();
    return settings;
}

Membrane membraneOf(const testing::Mesh& mesh, const MembraneSettings& settings) {
    return {"cell", 1, mesh.nodes, mesh.triangles, settings, 1};
}

double largest(const std::vector<Vec3>& vectors) {
    double most = 0;
    for (const Vec3& v : vectors) {
        most = std::max(most, v.cwiseAbs().maxCoeff());
    }
    return most;
}

// A sphere of springs under pressure: p dV = dE for a change of size, whatever the mesh, as for any other change.
TEST(Equilibrium, PressureDoesTheWorkThatSizeTakes) {
    for (const testing::Mesh& mesh : {testing::icosphere(2), testing::irregular(2)}) {
        Membrane cell = membraneOf(mesh, springs());
        Loads loads;
        loads.pressure = 1.2;
        const EquilibriumReport report = findEquilibrium(cell, loads, {.tolerance = 1e-9, .forceScale = 1});
        EXPECT_TRUE(report.converged);
        EXPECT_LE(report.iterations, 25);
        EXPECT_GT(cell.volume(), 1.2 * membraneOf(mesh, springs()).volume());
        const auto grown = [&](double factor, bool energy) {
            Membrane other = membraneOf(mesh, springs());
            for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
                other.position[n] = factor * cell.position[n];
            }
            return energy ? other.energy() : other.volume();
        };
        constexpr double h = 1e-4;
        const double dE = grown(1 + h, true) - grown(1 - h, true), dV = grown(1 + h, false) - grown(1 - h, false);
        EXPECT_NEAR(dE / dV, loads.pressure, 1e-6 * loads.pressure);
    }
}

// A cell with springs and bending, pulled apart at two nodes with no coordinate held: forces balance the loads, and
// every small change of shape costs work.
TEST(Equilibrium, OppositeLoadsDrawACellOutToAMinimum) {
    const testing::Mesh mesh = testing::irregular(2);
    Membrane cell = membraneOf(mesh, springs(", bending: {type: dihedral, kappa: 0.05 J}"));
    Loads loads;
    loads.force.assign(mesh.nodes.size(), Vec3::Zero());
    const auto byX = [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); };
    const auto right = std::max_element(mesh.nodes.begin(), mesh.nodes.end(), byX) - mesh.nodes.begin();
    const auto left = std::min_element(mesh.nodes.begin(), mesh.nodes.end(), byX) - mesh.nodes.begin();
    const Vec3 along = (mesh.nodes[right] - mesh.nodes[left]).normalized();
    loads.force[right] = 0.6 * along, loads.force[left] = -0.6 * along;
    const double before = (mesh.nodes[right] - mesh.nodes[left]).norm();
    const EquilibriumReport report = findEquilibrium(cell, loads, {.tolerance = 1e-8});
    ASSERT_TRUE(report.converged) << report.iterations << " iterations, residual " << report.residual;
    EXPECT_GT((cell.position[right] - cell.position[left]).norm(), 1.1 * before);
    EXPECT_LE(report.iterations, 60);
    std::vector<Vec3> total = cell.force;
    for (std::size_t n = 0; n < total.size(); ++n) {
        total[n] += loads.force[n];
    }
    EXPECT_LT(largest(total), 1e-8);
    const auto work = [&](const std::vector<Vec3>& x) {
        Membrane other = membraneOf(mesh, springs(", bending: {type: dihedral, kappa: 0.05 J}"));
        other.position = x;
        double sum = other.energy();
        for (std::size_t n = 0; n < x.size(); ++n) {
            sum -= loads.force[n].dot(x[n]);
        }
        return sum;
    };
    EXPECT_NEAR(work(cell.position), report.potential, 1e-12);
    for (unsigned seed = 0; seed < 5; ++seed) {
        std::vector<Vec3> x = cell.position;
        testing::jitter(x, 1e-3, seed);
        EXPECT_GT(work(x), report.potential);
    }
}

// The border of a regular lattice is held at a homogeneous strain: the inside takes this strain, starting from
// disorder.
TEST(Equilibrium, HeldBorderOfALatticeStrainsTheInsideHomogeneously) {
    const testing::Mesh mesh = testing::hexagonalPatch(6);
    Membrane sheet = membraneOf(mesh, springs());
    const auto strained = [](const Vec3& x) { return Vec3(1.15 * x.x() + 0.1 * x.y(), 1.05 * x.y(), 0); };
    Loads loads;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        const int i = static_cast<int>(n) % 7, j = static_cast<int>(n) / 7;
        const bool border = i == 0 || j == 0 || i == 6 || j == 6;
        loads.held.push_back({border, border, true});
        sheet.position[n] =
            strained(mesh.nodes[n]) + (border ? 0 : 0.1) * Vec3(std::sin(3.0 * i), std::cos(5.0 * j), 0);
    }
    const EquilibriumReport report = findEquilibrium(sheet, loads, {.tolerance = 1e-11, .forceScale = 1});
    EXPECT_TRUE(report.converged);
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        EXPECT_LT((sheet.position[n] - strained(mesh.nodes[n])).norm(), 1e-9);
    }
}

TEST(Equilibrium, RefusesWhatMakesNoSense) {
    const testing::Mesh patch = testing::hexagonalPatch(2);
    Membrane sheet = membraneOf(patch, springs());
    Loads loads;
    loads.pressure = 1;
    EXPECT_THROW(findEquilibrium(sheet, loads, {}), Failure);
    loads = {};
    loads.force.resize(2, Vec3::Zero());
    EXPECT_THROW(findEquilibrium(sheet, loads, {}), Failure);
    loads = {};
    sheet.position[1][0] = NAN;
    EXPECT_THROW(findEquilibrium(sheet, loads, {}), Failure);
}

}  // namespace
}  // namespace corpuscle::membrane
