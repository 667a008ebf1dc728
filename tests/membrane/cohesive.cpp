// Rupture by a tear that costs energy: what a weakened sheet keeps of its forces, strength, the energy of a tear, how
// damage ends and heals, and the line tension of rims.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases.hpp"
#include "membrane/cohesive.hpp"
#include "membrane/diagnostics.hpp"
#include "membrane/gradientDamage.hpp"
#include "tearCases.hpp"

namespace corpuscle::membrane {
namespace {

using namespace testing;

// All laws that weaken, on an irregular closed mesh in an arbitrary shape, with an arbitrary damage of its nodes.
Membrane weakenedCell(double damage, const std::string& triangles = "triangles: {type: neoHookean, Gs: 1 N/m}, ") {
    const MembraneSettings laws = settingsOf(
        "{bonds: {type: wlcPow, Gs: 1 N/m, x0: 0.3}, " + triangles +
        "angles: {type: harmonic, k: 0.2 J}, bending: {type: dihedral, kappa: 0.1 J}, area: {local: 2 N/m}, rupture: "
        "{type: cohesive, fractureEnergy: 1 N, length: 1 m}}");
    const Mesh mesh = testing::irregular(1);
    Membrane cell = membraneOf(mesh, laws);
    std::vector<double> d;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
        d.push_back(damage * (0.5 + 0.5 * std::sin(7.0 * static_cast<double>(n))));
    cell.restore(cell.network().aliveBonds(), d);
    cell.position = testing::deformed(mesh.nodes, 0.1);
    return cell;
}

TEST(Cohesive, ForcesAreMinusTheGradientOfTheEnergyThatIsLeft) {
    Membrane cell = weakenedCell(0.9);
    ASSERT_TRUE(cell.network().isWeakened());
    cell.computeForces();
    double largest = 0;
    for (const Vec3& f : cell.force) largest = std::max(largest, f.norm());
    const double h = 1e-6;
    for (std::size_t node = 0; node < cell.position.size(); ++node)
        for (int k = 0; k < 3; ++k) {
            const double start = cell.position[node][k];
            cell.position[node][k] = start + h;
            const double plus = cell.energy();
            cell.position[node][k] = start - h;
            const double minus = cell.energy();
            cell.position[node][k] = start;
            EXPECT_NEAR(cell.force[node][k], -(plus - minus) / (2 * h), 2e-7 * largest) << node;
        }
}

// The stiffness against differences of the forces, along a displacement of all nodes.
TEST(Cohesive, StiffnessIsTheDerivativeOfTheForces) {
    Membrane cell = weakenedCell(0.9);
    AssembledStiffness stiffness(cell.position.size());
    cell.addStiffness(Definiteness::exact, stiffness);
    const auto count = static_cast<Eigen::Index>(3 * cell.position.size());
    Eigen::VectorXd u(count);
    for (Eigen::Index k = 0; k < count; ++k) u[k] = std::cos(5.0 * static_cast<double>(k));
    const Eigen::VectorXd expected = stiffness * u;
    const double h = 1e-6;
    std::vector<std::vector<Vec3>> force(2, std::vector<Vec3>(cell.position.size(), Vec3::Zero()));
    for (const int side : {0, 1}) {
        std::vector<Vec3> x = cell.position;
        for (std::size_t n = 0; n < x.size(); ++n)
            x[n] += (side == 0 ? -h : h) * u.segment<3>(static_cast<Eigen::Index>(3 * n));
        cell.addElasticForces(x, force[side]);
    }
    for (std::size_t n = 0; n < cell.position.size(); ++n)
        EXPECT_LT(
            (expected.segment<3>(static_cast<Eigen::Index>(3 * n)) + (force[1][n] - force[0][n]) / (2 * h)).norm(),
            1e-6 * expected.norm());
}

// What a weakened network has lost is the part 1 - s of each triangle's energy in tension. In pure compression it loses
// nothing.
TEST(Cohesive, LosesAShareOfTheEnergyInTensionOnly) {
    Membrane whole = weakenedCell(0, ""), weak = weakenedCell(0.7, "");
    std::vector<double> tensile(weak.network().triangles().size(), 0.0);
    const MembraneType type(weak.network().stressFree(), weak.network().triangles(), weak.laws(), 1);
    for (const auto& term : type.terms()) term->addTensileEnergy(weak.position, tensile);
    double lost = 0;
    const std::vector<double> shares = keptShares(weak.network(), weak.damage());
    for (std::size_t t = 0; t < tensile.size(); ++t) {
        EXPECT_GE(tensile[t], 0);
        lost += (1 - shares[t]) * tensile[t];
    }
    EXPECT_GT(lost, 0.05 * whole.energy());
    EXPECT_NEAR(whole.energy() - weak.energy(), lost, 1e-12 * whole.energy());

    const MembraneSettings bonds = settingsOf(
        "{bonds: {type: harmonic, k: 1 N/m}, area: {local: 1 N/m}, rupture: {type: "
        "cohesive, fractureEnergy: 1e-9 N, length: 1 m}}");
    Membrane pressed = membraneOf(testing::irregular(1), bonds), untouched = membraneOf(testing::irregular(1), bonds);
    for (Membrane* m : {&pressed, &untouched})
        for (Vec3& x : m->position) x *= 0.8;
    pressed.restore(pressed.network().aliveBonds(), std::vector<double>(pressed.position.size(), 0.95));
    EXPECT_EQ(pressed.energy(), untouched.energy());
    EXPECT_TRUE(breakNow(untouched).empty());
    EXPECT_EQ(untouched.maxDamage(), 0);
}

// A sheet under uniaxial tension is elastic up to psi_c = 3 G/(16 l), and at a strain a little beyond it is damaged.
TEST(Cohesive, IsElasticUpToItsStrength) {
    const double fractureEnergy = 1e-4, onset = 3.0 / 16 * fractureEnergy;
    const MembraneSettings laws = settingsOf(tearingSheet(fractureEnergy));
    for (const auto& [factor, isDamaged] : {std::pair{0.999, false}, {1.001, true}}) {
        Membrane sheet = membraneOf(hexagonalPatch(6), laws);
        // Uniaxial strain E of Green: W = (Ks + Gs)/2 E^2.
        const double green = factor * std::sqrt(2 * onset / (0.4 + 0.66666666667));
        for (Vec3& x : sheet.position) x.y() *= std::sqrt(1 + 2 * green);
        breakNow(sheet);
        EXPECT_EQ(sheet.maxDamage() > 0, isDamaged) << factor;
    }
}

// Homogeneous damage at a given strain, in closed form: d = 1 - psi_c/psi.
TEST(Cohesive, HomogeneousDamage) {
    const double fractureEnergy = 1e-4, onset = 3.0 / 16 * fractureEnergy;
    Membrane sheet = membraneOf(hexagonalPatch(6), settingsOf(tearingSheet(fractureEnergy)));
    const double green = std::sqrt(3 * 2 * onset / (0.4 + 0.66666666667));
    for (Vec3& x : sheet.position) x.y() *= std::sqrt(1 + 2 * green);
    EXPECT_TRUE(breakNow(sheet).empty());
    for (const double d : sheet.damage()) EXPECT_NEAR(d, 1 - 1.0 / 3, 1e-7);
    // It stays when the sheet is unloaded, and after a restart from it.
    const std::vector<double> before = sheet.damage();
    sheet.position = sheet.initialPosition();
    breakNow(sheet, 1);
    EXPECT_EQ(sheet.damage(), before);
    Membrane other = membraneOf(hexagonalPatch(6), sheet.laws());
    other.restore(sheet.network().aliveBonds(), sheet.damage());
    for (Membrane* m : {&sheet, &other})
        for (Vec3& x : m->position) x.x() *= 1.003;
    EXPECT_EQ(other.energy(), sheet.energy());
    EXPECT_THROW(other.restore(sheet.network().aliveBonds(), std::vector<double>(7, 0.0)), Failure);
}

// A straight tear across a strip costs its energy for each length, on meshes with two to five edges in the length l.
TEST(Cohesive, AStraightTearCostsItsEnergyOnEveryMesh) {
    const double fractureEnergy = 1e-5, width = 4, height = 14;
    for (const auto& [edge, seed] : {std::pair{0.5, 1u}, {0.5, 2u}, {0.35, 3u}, {0.2, 4u}}) {
        const double h = std::sqrt(0.75) * edge;
        const Mesh mesh =
            rectangle(graded(0, width, edge, 0, 100, 1), graded(-0.5 * height, 0.5 * height, h, 0, 100, 1), 0.1, seed);
        const Membrane sheet = membraneOf(mesh, settingsOf(tearingSheet(fractureEnergy)));
        std::vector<double> damage(mesh.nodes.size(), 0.0);
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
            if (mesh.nodes[n].y() > -0.5 * h && mesh.nodes[n].y() < 1.5 * h) damage[n] = 1;
        const GradientDamage energy(sheet.network(), fractureEnergy, 1);
        energy.grow(std::vector<double>(mesh.triangles.size(), 0.0), damage);
        EXPECT_NEAR(energy.surfaceEnergy(damage) / (fractureEnergy * width), 1, 0.03) << edge;
        // The profile beside it; the correction for the row of triangles makes it a little narrower than on a fine
        // mesh.
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
            const double x = std::abs(mesh.nodes[n].y() - 0.5 * h) - 0.5 * h, end = 2 * (1 - 3 * h / 8);
            if (x <= 0) continue;
            EXPECT_NEAR(damage[n], std::pow(std::max(1 - x / end, 0.0), 2), 0.02 + 0.2 * edge) << edge << " " << x;
        }
    }
}

// A step may end where a node has gained between 0.2 and 0.4 of damage: the excess of homogeneous damage, whose gain is
// 1 - psi_c/psi.
TEST(Cohesive, GrowthIsAnEvent) {
    const double fractureEnergy = 1e-4, onset = 3.0 / 16 * fractureEnergy;
    Membrane sheet = membraneOf(hexagonalPatch(6), settingsOf(tearingSheet(fractureEnergy)));
    EXPECT_EQ(sheet.ruptureTolerance(), 1);
    for (const double ratio : {0.5, 1.1, 1.25, 1.6, 4.0}) {
        std::vector<Vec3> x = sheet.position;
        for (Vec3& p : x) p.y() *= std::sqrt(1 + 2 * std::sqrt(ratio * 2 * onset / (0.4 + 0.66666666667)));
        EXPECT_NEAR(sheet.ruptureExcess(x, 0), std::max(1 - 1 / ratio, 0.0) / 0.2 - 1, 1e-6) << ratio;
    }
    EXPECT_EQ(sheet.maxDamage(), 0) << "a question changes nothing";
}

// With `resealing` a tear whose lips have come together heals as exp(-t/tau) and its bonds hold again; without it, or
// while the lips are apart, it stays.
TEST(Cohesive, HealsWhereTheLipsMeetAgain) {
    for (const bool heals : {false, true}) {
        const Mesh mesh = rectangle(graded(0, 4, 0.5, 0, 100, 1), graded(-5, 5, 0.433, 0, 100, 1), 0.15, 1);
        Membrane sheet = membraneOf(mesh, settingsOf(tearingSheet(1e-5, heals ? ", resealing: 1 s" : "")));
        std::vector<double> damage(mesh.nodes.size(), 0.0);
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
            if (mesh.nodes[n].y() > -0.2 && mesh.nodes[n].y() < 0.65) damage[n] = 1;
        const auto part = [&](double gap) {
            for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
                sheet.position[n] = mesh.nodes[n] + Vec3(0, mesh.nodes[n].y() > 0.2 ? gap : 0, 0);
        };
        sheet.restore(sheet.network().aliveBonds(), damage);
        part(0.3);
        sheet.breakBonds(sheet.findBroken(0));
        const int broken = sheet.network().brokenBonds();
        ASSERT_GT(broken, 4);
        sheet.breakBonds(sheet.findBroken(5));
        EXPECT_EQ(sheet.network().brokenBonds(), broken) << "the lips are apart";
        EXPECT_GT(sheet.maxDamage(), 0.9);
        part(0);
        const double before = *std::max_element(sheet.damage().begin(), sheet.damage().end());
        sheet.breakBonds(sheet.findBroken(0.5));
        EXPECT_NEAR(*std::max_element(sheet.damage().begin(), sheet.damage().end()),
                    heals ? std::exp(-0.5) * before : before, 1e-7);
        EXPECT_EQ(sheet.network().brokenBonds(), broken);
        sheet.breakBonds(sheet.findBroken(0.5));
        EXPECT_EQ(sheet.network().brokenBonds(), heals ? 0 : broken);
        EXPECT_EQ(sheet.network().brokenTriangles() > 0, !heals);
    }
}

// What has left through a hole does not come back when it closes: a closed cell that was open stays so, and its volume
// is not held again, also after a restart.
TEST(Cohesive, AResealedCellStaysOneThatWasOpen) {
    const std::string laws =
        "{bonds: {type: harmonic, k: 1 N/m}, volume: {modulus: 5 Pa}, rupture: {type: cohesive, "
        "fractureEnergy: 1 N, length: 1 m, resealing: 1 s}}";
    Membrane cell = membraneOf(testing::icosphere(2), settingsOf(laws));
    for (Vec3& x : cell.position) x *= 0.9;
    EXPECT_FALSE(cell.network().isOpen());
    const double closed = cell.energy();
    std::vector<double> damage(cell.position.size(), 0.0);
    for (const int t : cell.network().bondTriangles(100))
        for (const int n : cell.network().triangles()[t]) damage[n] = 1;
    cell.restore(cell.network().aliveBonds(), damage);
    EXPECT_GT(cell.breakBonds(cell.findBroken(0)).size(), 0u);
    EXPECT_TRUE(cell.network().isOpen());
    EXPECT_LT(cell.energy(), closed);
    const double open = cell.energy();
    EXPECT_TRUE(cell.findBroken(20).empty());
    EXPECT_EQ(cell.network().brokenBonds(), 0);
    EXPECT_TRUE(cell.network().isOpen() && cell.network().wasOpen());
    EXPECT_LT(cell.energy(), 0.5 * (open + closed));
    Membrane other = membraneOf(testing::icosphere(2), settingsOf(laws));
    other.position = cell.position;
    other.restore(cell.network().aliveBonds(), cell.damage());
    EXPECT_TRUE(other.network().wasOpen());
    EXPECT_EQ(other.energy(), cell.energy());
}

// A round hole under the tension sigma: at r = gamma/sigma its rim stays where it is, so that every displacement is
// that of the sheet without a hole; a smaller hole closes and a larger one opens.
TEST(Rim, HoleIsInEquilibriumAtLineTensionOverTension) {
    const double sigma = 1e-3;
    const auto opening =
        [&](double ratio) {  // radial displacement of the rim beyond that of a whole sheet, over r sigma
            const int rings = 24;
            Mesh mesh;
            mesh.nodes.emplace_back(0, 0, 0);
            std::vector<std::vector<int>> ring{{0}};
            for (int k = 1; k <= rings; ++k) {
                ring.emplace_back();
                for (int i = 0; i < 6 * k; ++i) {
                    const double angle = 2 * std::numbers::pi * i / (6 * k);
                    ring.back().push_back(static_cast<int>(mesh.nodes.size()));
                    mesh.nodes.emplace_back(k * std::cos(angle), k * std::sin(angle), 0);
                }
            }
            for (int k = 1; k <= rings; ++k) {
                const std::vector<int>&inner = ring[k - 1], &outer = ring[k];
                const auto at = [](const std::vector<int>& r, int i) {
                    return r[static_cast<std::size_t>(i) % r.size()];
                };
                for (int side = 0; side < 6; ++side)
                    for (int i = 0; i < k; ++i) {
                        const int a = side * k + i, b = side * (k - 1) + i;
                        mesh.triangles.push_back({at(outer, a), at(outer, a + 1), at(inner, b)});
                        if (i + 1 < k) mesh.triangles.push_back({at(inner, b), at(outer, a + 1), at(inner, b + 1)});
                    }
            }
            const int hole = 8;
            const MembraneSettings laws = settingsOf(
                "{triangles: {type: linear, Gs: 0.4 N/m, Ks: 0.66666666667 N/m}, rupture: "
                "{type: bondStretch, limit: 9}, rim: {tension: " +
                fmt::format("{:.10g}", ratio * sigma * hole) + " N}}");
            Membrane sheet = membraneOf(mesh, laws);
            std::vector<char> alive = sheet.network().aliveBonds();
            for (const Bond& bond : sheet.network().allBonds()) {
                const double a = mesh.nodes[bond.node[0]].norm(), b = mesh.nodes[bond.node[1]].norm();
                if (std::min(a, b) < hole - 0.5) alive[bond.number] = 0;
            }
            sheet.restore(alive);
            EXPECT_EQ(sheet.network().rims().size(), 1u);
            EXPECT_EQ(sheet.network().rims().front().size(), 6u * hole);
            Loads loads;
            loads.held.assign(mesh.nodes.size(), {false, false, true});
            loads.force.assign(mesh.nodes.size(), Vec3::Zero());
            for (const int n : ring.back())
                loads.force[n] = sigma * 2 * std::numbers::pi * rings / (6 * rings) * mesh.nodes[n].normalized();
            for (int k = 0; k < hole; ++k)
                for (const int n : ring[k]) loads.held[n] = {true, true, true};
            const EquilibriumReport report = findEquilibrium(sheet, loads, {1e-7, sigma, 100});
            EXPECT_TRUE(report.converged);
            double radius = 0;
            for (const int n : ring[hole]) radius += sheet.position[n].norm() / (6 * hole);
            return (radius / hole - 1 - sigma / (2 * 0.66666666667)) / sigma;
        };
    // Lame's solution for a hole under the traction gamma/r on its rim in a disc of radius R: the displacement of the
    // rim beyond the homogeneous one is (1 - gamma/(r sigma)) sigma r/E ((1 + nu) + (1 - nu) q)/(1 - q), q = (r/R)^2.
    const double q = std::pow(8.0 / 24, 2), slope = (1.25 + 0.75 * q) / (1 - q);
    EXPECT_NEAR(opening(1), 0, 0.03 * slope);
    EXPECT_NEAR(opening(0.5) / slope, 0.5, 0.03);
    EXPECT_NEAR(opening(1.5) / slope, -0.5, 0.03);
}

}  // namespace
}  // namespace corpuscle::membrane
