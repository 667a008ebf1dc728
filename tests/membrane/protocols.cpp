// The protocols of membraneRelax on small meshes: loads in balance, and inflation of a sphere against the law's
// formula.
#include <gtest/gtest.h>

#include "membrane/protocol.hpp"
#include "meshes.hpp"
#include "settingsText.hpp"

namespace corpuscle::membrane {
namespace {

std::shared_ptr<const Protocol> protocol(const std::string& text) { return testing::chosen<Protocol>(text); }

Membrane cellOf(const testing::Mesh& mesh, const std::string& laws) {
    return {"cell", 1, mesh.nodes, mesh.triangles, testing::parsed<MembraneSettings>(laws), 1};
}

// Pressure of a neo-Hookean sphere: p a/Gs = 2 (1 - l^-6)/l; a mesh of edge 0.14 is 0.4 % smaller than its sphere.
TEST(Protocols, ASphereInflatesAsItsLawSays) {
    const auto inflation = protocol("{type: inflation, pressures: [0.3 Pa, 0.8 Pa, 1.1 Pa]}");
    Membrane cell = cellOf(testing::icosphere(3), "{triangles: {type: neoHookean, Gs: 1 N/m}}");
    ASSERT_EQ(inflation->stages(), 3);
    for (int stage = 0; stage < 3; ++stage) {
        const Loads loads = inflation->apply(stage, cell);
        ASSERT_TRUE(findEquilibrium(cell, loads, {.tolerance = 1e-8, .forceScale = 1e-2}).converged);
        const std::vector<double> row = inflation->measure(stage, cell);
        const double l = row[2];
        EXPECT_NEAR(2 * (1 - std::pow(l, -6)) / l, row[0], 5e-3 * row[0]);
    }
}

TEST(Protocols, TweezersPullWithTheForceTheyName) {
    const auto tweezers = protocol("{type: tweezers, forces: [0.5 N], contact: 0.8 m}");
    Membrane cell = cellOf(testing::irregular(2), "{bonds: {type: harmonic, k: 2 N/m}}");
    const Loads loads = tweezers->apply(0, cell);
    double right = 0, left = 0;
    for (std::size_t n = 0; n < loads.force.size(); ++n) {
        (loads.force[n][0] > 0 ? right : left) += loads.force[n][0];
        if (loads.force[n][0] != 0) {
            EXPECT_GT(loads.force[n][0] * cell.position[n][0], 0) << "pulled outwards";
        }
    }
    EXPECT_NEAR(right, 0.5, 1e-12);
    EXPECT_NEAR(left, -0.5, 1e-12);
    const double before = tweezers->measure(0, cell)[1];
    ASSERT_TRUE(findEquilibrium(cell, loads, {}).converged);
    EXPECT_GT(tweezers->measure(0, cell)[1], 1.1 * before);
    EXPECT_THROW(protocol("{type: tweezers, forces: [0 N], contact: 9 m}")->apply(0, cell), Failure);
    EXPECT_THROW(protocol("{type: tweezers, forces: []}"), CaseError);
    EXPECT_THROW(protocol("{type: inflation, pressures: []}"), CaseError);
}

// The displaced nodes of a sphere of springs return to their rest shape, up to a rigid motion.
TEST(Protocols, AShakenCellComesToRestInItsShape) {
    const testing::Mesh mesh = testing::icosphere(1);
    Membrane cell = cellOf(mesh, "{bonds: {type: harmonic, k: 2 N/m}, bending: {type: dihedral, kappa: 0.1 J}}");
    const auto resting = protocol("{type: resting, shake: 0.05 m}");
    const Loads loads = resting->apply(0, cell);
    EXPECT_GT(cell.energy(), 1e-3);
    ASSERT_TRUE(findEquilibrium(cell, loads, {.tolerance = 1e-10, .forceScale = 1}).converged);
    EXPECT_LT(cell.energy(), 1e-18);
    EXPECT_NEAR(cell.volume(), cellOf(mesh, "{bonds: {type: harmonic, k: 2 N/m}}").volume(), 1e-9);
}

}  // namespace
}  // namespace corpuscle::membrane
