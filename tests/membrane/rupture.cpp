// Broken bonds end in every law; holes, their rims and areas; restoring; the functions of Membrane.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "cases.hpp"
#include "core/error.hpp"
#include "membrane/diagnostics.hpp"
#include "membrane/surface.hpp"
#include "ruptureCases.hpp"

namespace corpuscle::membrane {
namespace {

using namespace testing;

bool hasBond(const Network& network, const std::array<int, 2>& node) {
    return std::any_of(network.bonds().begin(), network.bonds().end(), [&](const Bond& b) { return b.node == node; });
}

TEST(Network, CountsAndOrder) {
    const Mesh mesh = testing::icosphere(2);
    Network network(mesh.nodes, mesh.triangles);
    EXPECT_EQ(network.bonds().size(), 480u);  // Euler: 162 - 480 + 320 = 2
    EXPECT_FALSE(network.isOpen());
    EXPECT_TRUE(network.corners().empty());
    EXPECT_TRUE(network.hinges().empty());
    for (std::size_t b = 1; b < network.bonds().size(); ++b) {
        EXPECT_LT(network.bonds()[b - 1].node, network.bonds()[b].node);
        EXPECT_LT(network.bonds()[b].node[0], network.bonds()[b].node[1]);
    }
    network.useCorners();
    EXPECT_EQ(network.corners().size(), 960u);
    EXPECT_TRUE(network.hinges().empty());
}

TEST(Network, RefusesBadMeshesByName) {
    Mesh mesh = testing::icosphere(0);
    std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
    try {
        Network network(mesh.nodes, mesh.triangles);
        FAIL() << "a turned triangle was accepted";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::invalidCase);
        EXPECT_NE(std::string(failure.what()).find("the same way along the edge"), std::string::npos);
    }
    mesh = testing::icosphere(0);
    mesh.triangles[0][1] = 12;
    EXPECT_THROW(Network(mesh.nodes, mesh.triangles), Failure);
    mesh = testing::icosphere(0);
    mesh.nodes[0] = mesh.nodes[11];
    EXPECT_THROW(Network(mesh.nodes, mesh.triangles), Failure);
}

// Bonds and hinges after a break are those of the mesh without the broken triangles; of the broken triangles' corners
// only the two opposite the broken bond remain.
TEST(Rupture, OneBondLeavesEveryLaw) {
    const Mesh mesh = testing::irregular(2);
    const std::vector<Vec3> x = testing::deformed(mesh.nodes, 0.28);
    HarmonicBond bonds;
    bonds.k = 1.3;
    DihedralBending bending;
    bending.k = 0.4;
    HarmonicAngle angles;
    angles.k = 0.9;

    Network network(mesh.nodes, mesh.triangles);
    const auto bondTerm = bonds.makeTerm(network), bendingTerm = bending.makeTerm(network, {}),
               angleTerm = angles.makeTerm(network);
    const int number = 100;
    network.breakBonds(std::array{number});
    EXPECT_TRUE(network.isOpen());
    EXPECT_EQ(network.brokenBonds(), 1);
    EXPECT_EQ(network.brokenTriangles(), 2);

    const auto [left, right] = network.bondTriangles(number);
    Mesh without = mesh;
    without.triangles.clear();
    double oppositeCorners = 0;
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
        if (t != left && t != right) {
            without.triangles.push_back(mesh.triangles[t]);
            continue;
        }
        EXPECT_TRUE(network.isBroken(t));
        const auto& edge = network.allBonds()[number].node;
        Index3 corner = mesh.triangles[t];
        while (corner[0] == edge[0] || corner[0] == edge[1]) {
            std::rotate(corner.begin(), corner.begin() + 1, corner.end());
        }
        const double rest =
            CornerAngle::at({mesh.nodes[corner[0]], mesh.nodes[corner[1]], mesh.nodes[corner[2]]}).value;
        oppositeCorners += angles.energy(CornerAngle::at({x[corner[0]], x[corner[1]], x[corner[2]]}).value, rest);
    }
    Network reduced(without.nodes, without.triangles);
    EXPECT_EQ(bondTerm->energy(x), bonds.makeTerm(reduced)->energy(x));
    EXPECT_NEAR(bendingTerm->energy(x), bending.makeTerm(reduced, {})->energy(x), 1e-12);
    EXPECT_NEAR(angleTerm->energy(x), angles.makeTerm(reduced)->energy(x) + oppositeCorners, 1e-12);

    // A second break elsewhere, together with a bond that is broken already.
    network.breakBonds(std::array{number, 300});
    EXPECT_EQ(network.brokenBonds(), 2);
}

// A sphere cut along its equator comes apart in two sheets, with one rim each.
TEST(Network, SheetsAreWhatIsConnected) {
    const Mesh mesh = testing::icosphere(2);
    Network network(mesh.nodes, mesh.triangles);
    std::vector<int> sheet = network.sheetOfNodes();
    EXPECT_EQ(std::count(sheet.begin(), sheet.end(), 0), 162);
    EXPECT_FALSE(network.isTorn());
    std::vector<int> cut;
    for (const Bond& bond : network.allBonds()) {
        if ((mesh.nodes[bond.node[0]].y() < 0.2) != (mesh.nodes[bond.node[1]].y() < 0.2)) {
            cut.push_back(bond.number);
        }
    }
    network.breakBonds(cut);
    EXPECT_TRUE(network.isTorn());
    sheet = network.sheetOfNodes();
    EXPECT_EQ(network.rims().size(), 2u);
    for (int node = 0; node < 162; ++node) {
        const bool isFirst = (mesh.nodes[node].y() < 0.2) == (mesh.nodes[0].y() < 0.2);
        EXPECT_EQ(sheet[node], isFirst ? 0 : 1) << node;
    }
    // A node without whole triangles belongs to no sheet.
    cut.clear();
    for (const Bond& bond : network.allBonds()) {
        if (bond.node[0] == 0 || bond.node[1] == 0) {
            cut.push_back(bond.number);
        }
    }
    network.breakBonds(cut);
    EXPECT_EQ(network.sheetOfNodes()[0], -1);
}

TEST(Rupture, ForcesStayMinusTheGradient) {
    const Mesh mesh = testing::irregular(1);
    Membrane membrane = membraneOf(mesh, allLaws());
    membrane.position = testing::deformed(mesh.nodes, 0.1);
    const auto broken = breakNow(membrane);
    ASSERT_GT(broken.size(), 5u);
    ASSERT_LT(broken.size(), 100u);
    membrane.computeForces();
    const double h = 1e-5;
    for (int node = 0; node < 42; ++node) {
        const double start = membrane.position[node].x();
        membrane.position[node].x() = start + h;
        const double plus = membrane.energy();
        membrane.position[node].x() = start - h;
        const double minus = membrane.energy();
        membrane.position[node].x() = start;
        EXPECT_NEAR(membrane.force[node].x(), -(plus - minus) / (2 * h), 1e-7);
    }
}

TEST(Rupture, BondStretchNamesWhatBroke) {
    Membrane membrane = membraneOf(testing::icosphere(2), allLaws());
    for (Vec3& x : membrane.position) {
        x *= 1.0499;
    }
    EXPECT_TRUE(breakNow(membrane).empty());
    EXPECT_FALSE(membrane.network().isOpen());

    membrane.position[7] *= 1.3;
    const std::size_t bondsOfNode = std::count_if(membrane.network().bonds().begin(), membrane.network().bonds().end(),
                                                  [](const Bond& b) { return b.node[0] == 7 || b.node[1] == 7; });
    const auto broken = breakNow(membrane);
    ASSERT_EQ(broken.size(), bondsOfNode);
    for (const BrokenBond& bond : broken) {
        const auto [a, b] = membrane.network().allBonds()[bond.bond].node;
        EXPECT_TRUE(a == 7 || b == 7);
        EXPECT_GT(bond.stretch, 1.05);
        EXPECT_LT((bond.place - 0.5 * (membrane.position[a] + membrane.position[b])).norm(), 1e-15);
        EXPECT_FALSE(hasBond(membrane.network(), {a, b}));
    }
    EXPECT_TRUE(breakNow(membrane).empty());  // what has broken does not break again
    membrane.computeForces();
    EXPECT_EQ(membrane.force[7].norm(), 0);  // the node is free
}

TEST(Rupture, WithoutACriterionNothingBreaks) {
    MembraneSettings settings = allLaws();
    settings.rupture = {};
    Membrane membrane = membraneOf(testing::icosphere(1), settings);
    for (Vec3& x : membrane.position) {
        x *= 3;
    }
    EXPECT_FALSE(membrane.canRupture());
    EXPECT_TRUE(breakNow(membrane).empty());
}

// For each registered law, on a sheet that is stretched more and more and torn along the way: the excess is positive
// exactly where something breaks, and grows with the measure in proportion to its limit.
TEST(Rupture, ExcessIsPositiveWhereSomethingBreaks) {
    const std::string sheet = "{triangles: {type: neoHookean, Gs: 1 N/m}, bonds: {type: harmonic, k: 1 N/m}, rupture: ";
    const std::map<std::string, std::string> laws{{"bondStretch", "{type: bondStretch, limit: 1.05}"},
                                                  {"arealStrain", "{type: arealStrain, limit: 0.09}"},
                                                  {"tension", "{type: tension, limit: 0.25 N/m}"},
                                                  {"damage", "{type: damage, onset: 0.02, scale: 0.05, time: 4 s}"}};
    // A law that weakens the sheet before it breaks has other events: Cohesive.GrowthIsAnEvent.
    for (const auto& entry : Registry<RuptureLaw>::instance().names())
        ASSERT_TRUE(laws.contains(entry) || entry == "cohesive") << entry;
    for (const auto& [name, law] : laws) {
        Problems problems;
        const auto settings = read<MembraneSettings>(parseValue(sheet + law + "}", "test", problems), problems);
        problems.throwIfAny();
        const Mesh mesh = testing::irregular(2);
        Membrane membrane = membraneOf(mesh, settings);
        std::vector<Vec3> x = mesh.nodes;
        int whole = 0, torn = 0;
        EXPECT_LE(membrane.ruptureExcess(x, 0), 0) << name;
        for (int step = 1; step <= 60; ++step) {
            testing::jitter(x, 0.0005, 20 + step);
            for (Vec3& p : x) p *= 1.0015;
            membrane.position = x;
            const double excess = membrane.ruptureExcess(x, 0.1);
            const auto broken = membrane.findBroken(0.1);
            EXPECT_EQ(excess > 0, !broken.empty()) << name << " " << step << " " << excess;
            ++(broken.empty() ? whole : torn);
            membrane.breakBonds(broken);
            EXPECT_LE(membrane.ruptureExcess(x, 0), 0) << name << ": nothing more breaks at once";
        }
        EXPECT_GT(whole, 5) << name;
        EXPECT_GT(torn, 5) << name;
    }
    // Bonds of one stretch: its distance from the limit is known.
    Membrane ball = membraneOf(testing::icosphere(1), allLaws());
    for (const double factor : {0.9, 1.0, 1.04, 1.2}) {
        std::vector<Vec3> x = ball.position;
        for (Vec3& p : x) p *= factor;
        EXPECT_NEAR(ball.ruptureExcess(x, 0), factor / 1.05 - 1, 1e-12);
    }
}

TEST(Holes, RimsAndAreasOnAFlatPatch) {
    const Mesh mesh = testing::hexagonalPatch(9);
    Network network(mesh.nodes, mesh.triangles);
    const auto openNode = [&](int i, int j) {
        std::vector<int> numbers;
        for (const Bond& b : network.allBonds()) {
            if (b.node[0] == 10 * j + i || b.node[1] == 10 * j + i) {
                numbers.push_back(b.number);
            }
        }
        network.breakBonds(numbers);
    };
    EXPECT_TRUE(network.isOpen());  // it has a border
    EXPECT_TRUE(network.rims().empty());
    const double hexagon = 6 * std::sqrt(3.0) / 4;

    openNode(3, 3);
    ASSERT_EQ(network.rims().size(), 1u);
    EXPECT_EQ(network.rims()[0].size(), 6u);
    EXPECT_NEAR(network.holeRestArea(), hexagon, 1e-12);
    std::vector<Vec3> x = mesh.nodes;
    for (Vec3& p : x) {
        p.x() *= 2;
    }
    x[33] = Vec3(100, 100, 100);  // the freed node has no part in the hole
    EXPECT_NEAR(network.holeArea(x), 2 * hexagon, 1e-12);

    openNode(5, 3);  // touches the first at one node: two holes
    ASSERT_EQ(network.rims().size(), 2u);
    EXPECT_EQ(network.rims()[0].size(), 6u);
    EXPECT_EQ(network.rims()[1].size(), 6u);
    x[35] = x[33];
    EXPECT_NEAR(network.holeArea(x), 4 * hexagon, 1e-12);

    openNode(2, 5);  // an edge in common with the first: one hole with a strand across it
    ASSERT_EQ(network.rims().size(), 2u);
    EXPECT_EQ(network.rims()[0].size() + network.rims()[1].size(), 6u + 10u);
    EXPECT_NEAR(network.holeRestArea(), 3 * hexagon, 1e-12);
    x[52] = x[33];
    EXPECT_NEAR(network.holeArea(x), 6 * hexagon, 1e-11);
}

TEST(Holes, VolumeStaysClosedByTheRim) {
    Membrane membrane = membraneOf(testing::icosphere(3), allLaws());
    const double whole = membrane.volume();
    EXPECT_NEAR(whole, 0.9913938426297549 * 4 * std::numbers::pi / 3, 1e-12);
    EXPECT_NEAR(membrane.area(), 0.9952350696770933 * 4 * std::numbers::pi, 1e-12);
    const auto areas = membrane.vertexAreas();
    double sum = 0;
    for (const double a : areas) {
        sum += a;
    }
    EXPECT_NEAR(sum, membrane.area(), 1e-12);

    membrane.position[20] *= 1.4;
    ASSERT_GE(breakNow(membrane).size(), 5u);
    EXPECT_NEAR(membrane.volume(), whole, 1e-3 * whole);
    EXPECT_LT(membrane.volume(), whole);  // the cap is cut off
    const double before = membrane.volume();
    for (Vec3& x : membrane.position) {
        x += Vec3(5, -3, 2);
    }
    EXPECT_NEAR(membrane.volume(), before, 1e-12);
}

TEST(Restore, SameBitsAsTheRunThatBroke) {
    const Mesh mesh = testing::irregular(2);
    Membrane broke = membraneOf(mesh, allLaws());
    std::vector<Vec3> x = mesh.nodes;
    for (int step = 0; step < 3; ++step) {
        testing::jitter(x, 0.01, 20 + step);
        broke.position = x;
        breakNow(broke);
    }
    ASSERT_GT(broke.network().brokenBonds(), 10);
    Membrane restored = membraneOf(mesh, allLaws());
    restored.restore(broke.network().aliveBonds());
    restored.position = broke.position;
    broke.computeForces();
    restored.computeForces();
    EXPECT_EQ(restored.network().brokenTriangles(), broke.network().brokenTriangles());
    for (std::size_t n = 0; n < x.size(); ++n) {
        EXPECT_EQ(restored.force[n], broke.force[n]);
    }
    EXPECT_EQ(restored.energy(), broke.energy());
    EXPECT_EQ(restored.volume(), broke.volume());
    EXPECT_THROW(restored.restore(std::vector<char>(3, 1)), Failure);
}

TEST(MembraneLaws, ThoseNotNamedHaveNoStorage) {
    MembraneSettings settings = allLaws();
    settings.angles = {};
    settings.bending = {};
    Membrane membrane = membraneOf(testing::icosphere(1), settings);
    EXPECT_TRUE(membrane.network().corners().empty());
    EXPECT_TRUE(membrane.network().hinges().empty());
    Membrane moved = std::move(membrane);  // terms follow
    moved.position[0] *= 1.01;
    moved.computeForces();
    EXPECT_GT(moved.force[0].norm(), 0);
}

TEST(Diagnostics, HexagonalPatchUnderEqualStretch) {
    const Mesh mesh = testing::hexagonalPatch(4);
    Network network(mesh.nodes, mesh.triangles);
    HarmonicBond law;
    law.k = 2;
    std::vector<Vec3> x = mesh.nodes;
    for (Vec3& p : x) {
        p *= 1.1;
    }
    const auto tensions = principalTensions(network, testing::only(law), x);
    const auto strain = areaStrain(network, x);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        EXPECT_NEAR(tensions.tension1[t], std::sqrt(3.0) * law.k * 0.1 / 1.1, 1e-12);  // sqrt(3) k (l - l0)/l
        EXPECT_NEAR(tensions.tension2[t], tensions.tension1[t], 1e-12);
        EXPECT_NEAR(strain[t], 0.21, 1e-12);
    }
    for (const double stretch : nodeStretch(network, x)) {
        EXPECT_NEAR(stretch, 1.1, 1e-12);
    }
    EXPECT_NEAR(maxBondStrain(network, x), 0.1, 1e-12);
}

// Sum of A (tension1 + tension2) over a closed membrane is the virial of its bonds, sum of E'(l) l.
TEST(Diagnostics, TensionsCarryTheVirial) {
    const Mesh mesh = testing::irregular(2);
    Network network(mesh.nodes, mesh.triangles);
    HarmonicBond law;
    law.k = 2;
    const auto x = testing::deformed(mesh.nodes, 0.28);
    const auto tensions = principalTensions(network, testing::only(law), x);
    double surface = 0, virial = 0, largest = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        surface += areaVector(x, mesh.triangles[t]).norm() * (tensions.tension1[t] + tensions.tension2[t]);
        EXPECT_GE(tensions.tension1[t], tensions.tension2[t]);
    }
    for (const Bond& bond : network.bonds()) {
        const double l = (x[bond.node[1]] - x[bond.node[0]]).norm();
        virial += law.derivative(l, bond.rest) * l;
        largest = std::max(largest, l / bond.rest - 1);
    }
    EXPECT_NEAR(surface, virial, 1e-12 * std::abs(virial));
    EXPECT_EQ(maxBondStrain(network, x), largest);
}

TEST(Rupture, ArealStrainBreaksTheMostStretchedBondOfATriangle) {
    const std::string laws = "{triangles: {type: neoHookean, Gs: 1 N/m}, rupture: {type: arealStrain, limit: 0.04}}";
    EXPECT_TRUE(breakNow(strainedSheet(laws, 1.30, 0.79)).empty()) << "long, but no greater: 2.7 %";
    EXPECT_TRUE(breakNow(strainedSheet(laws, 1.019, 1.02)).empty());
    Membrane sheet = strainedSheet(laws, 1.05, 1.0);  // rows along x are stretched most
    const std::vector<BrokenBond> broken = breakNow(sheet);
    EXPECT_EQ(broken.size(), 20u) << "5 rows of 4 bonds, each once";
    for (const BrokenBond& bond : broken) {
        EXPECT_NEAR(bond.stretch, 1.05, 1e-12);
    }
    EXPECT_EQ(sheet.network().brokenTriangles(), 32);
    EXPECT_TRUE(breakNow(sheet).empty()) << "no triangle is left";
}

// Equibiaxial stretch l of a neo-Hookean sheet: T = Gs (1 - l^-6).
TEST(Rupture, TensionBreaksAtTheLawsTension) {
    const double l = 1.1, tension = 1 - std::pow(l, -6);
    const auto laws = [](double limit) {
        return "{triangles: {type: neoHookean, Gs: 1 N/m}, rupture: {type: tension, limit: " + std::to_string(limit) +
               " N/m}}";
    };
    EXPECT_TRUE(breakNow(strainedSheet(laws(1.01 * tension), l, l)).empty());
    EXPECT_FALSE(breakNow(strainedSheet(laws(0.99 * tension), l, l)).empty());
    EXPECT_TRUE(breakNow(strainedSheet(laws(0.99 * tension), 1 / l, 1 / l)).empty()) << "compression";
}

}  // namespace
}  // namespace corpuscle::membrane
