// Moduli of the laws against closed forms, and the bending energies of curved lattices.
#include "membrane/moduli.hpp"

#include <gtest/gtest.h>

#include "cases.hpp"
#include "membrane/dihedralBending.hpp"
#include "membrane/harmonicAngle.hpp"
#include "membrane/harmonicBond.hpp"
#include "membrane/surface.hpp"
#include "meshes.hpp"

namespace corpuscle::membrane {
namespace {

using testing::Mesh;

HarmonicBond bondOf(double k) {
    HarmonicBond law;
    law.k = k;
    return law;
}

// x + eps.x with a plane strain.
std::vector<Vec3> strained(std::vector<Vec3> x, double xx, double yy, double xy) {
    for (Vec3& p : x) {
        p = Vec3(p.x() + xx * p.x() + xy * p.y(), p.y() + xy * p.x() + yy * p.y(), p.z());
    }
    return x;
}

// Energy per area of a hexagonal lattice under a strain, from the law's own term.
template <class Law>
double energyPerArea(
    const Law& law, double xx, double yy, double xy, const std::function<void(Mesh&)>& change = [](Mesh&) {},
    double cell = testing::hexagonalCell) {
    return testing::bulk([&](const Mesh& flat) {
               Mesh mesh = flat;
               change(mesh);
               Network network(mesh.nodes, mesh.triangles);
               return law.makeTerm(network)->energy(strained(mesh.nodes, xx, yy, xy));
           }) /
           cell;
}

// W = Ks/2 (tr eps)^2 + 2 Gs e^2 for eps = e diag(1, -1) or e (offdiagonal). Closed forms: analytic, spring_network
// table of the reference data (harmonic: G/k = 0.4330127, K/k = 0.8660254); that of the angle law is in its header.
TEST(Moduli, HexagonalLatticeOfHarmonicBonds) {
    constexpr double e = 1e-5, k = 2;
    const HarmonicBond law = bondOf(k);
    EXPECT_NEAR(energyPerArea(law, e, e, 0) / (2 * e * e), 0.8660254037844386 * k, 1e-3 * k);
    EXPECT_NEAR(energyPerArea(law, e, -e, 0) / (2 * e * e), 0.4330127018922193 * k, 4e-4 * k);
    EXPECT_NEAR(energyPerArea(law, 0, 0, e) / (2 * e * e), 0.4330127018922193 * k, 4e-4 * k);
    EXPECT_NEAR(law.hexagonalModuli(1).shear, 0.4330127018922193 * k, 1e-12);
    EXPECT_NEAR(law.hexagonalModuli(1).area, 0.8660254037844386 * k, 1e-12);
}

TEST(Moduli, HexagonalLatticeOfHarmonicAngles) {
    constexpr double e = 1e-5;
    HarmonicAngle law;
    law.k = 2;
    EXPECT_NEAR(energyPerArea(law, e, e, 0) / (2 * e * e), 0, 1e-8);
    EXPECT_NEAR(energyPerArea(law, e, -e, 0) / (2 * e * e), 1.5 * std::sqrt(3.0) * law.k, 1e-3 * law.k);
    EXPECT_NEAR(energyPerArea(law, 0, 0, e) / (2 * e * e), 1.5 * std::sqrt(3.0) * law.k, 1e-3 * law.k);
}

TEST(Moduli, MeasuredOnARegularPatch) {
    const Mesh mesh = testing::hexagonalPatch(8);
    const NetworkModuli m = measureModuli(Network(mesh.nodes, mesh.triangles), testing::only(bondOf(2)));
    EXPECT_NEAR(m.shear, m.closedForm.shear, 1e-3 * m.closedForm.shear);
    EXPECT_NEAR(m.area, m.closedForm.area, 1e-3 * m.closedForm.area);
    EXPECT_NEAR(m.shearAnisotropy, 1, 1e-9);
    EXPECT_NEAR(m.worstAxialAnisotropy, 1, 1e-9);
    EXPECT_LT(m.deviation, 1e-6);
    EXPECT_NE(describe(m).find("1.0000 of closed form"), std::string::npos);
}

// A lattice whose rest state is stretched is anisotropic: least and greatest moduli of measureModuli against energies
// in all directions.
TEST(Moduli, MeasuredAnisotropyAgreesWithEnergies) {
    const auto stretch = [](Mesh& mesh) {
        for (Vec3& x : mesh.nodes) {
            x.x() *= 1.4;
        }
    };
    Mesh mesh = testing::hexagonalPatch(4);
    stretch(mesh);
    const HarmonicBond law = bondOf(1);
    const NetworkModuli m = measureModuli(Network(mesh.nodes, mesh.triangles), testing::only(law));

    constexpr double e = 1e-5;
    constexpr int directions = 60;
    double low = 1e9, high = 0, mean = 0, axialLow = 1e9, axialHigh = 0;
    for (int k = 0; k < directions; ++k) {
        const double c = std::cos(2 * std::numbers::pi * k / directions),
                     s = std::sin(2 * std::numbers::pi * k / directions);
        const double cell = 1.4 * testing::hexagonalCell;
        const double shear = energyPerArea(law, e * c, -e * c, e * s, stretch, cell) / (2 * e * e);
        const double axial =
            energyPerArea(law, e * (1 + c) / 2, e * (1 - c) / 2, e * s / 2, stretch, cell) * 2 / (e * e);
        mean += shear / directions;
        low = std::min(low, shear);
        high = std::max(high, shear);
        axialLow = std::min(axialLow, axial);
        axialHigh = std::max(axialHigh, axial);
    }
    EXPECT_LT(m.shearAnisotropy, 0.9);
    EXPECT_NEAR(m.shear, mean, 1e-3 * mean);
    EXPECT_NEAR(m.area, energyPerArea(law, e, e, 0, stretch, 1.4 * testing::hexagonalCell) / (2 * e * e),
                1e-3 * m.area);
    EXPECT_NEAR(m.shearAnisotropy, low / high, 1e-3);
    EXPECT_NEAR(m.axialAnisotropy, axialLow / axialHigh, 1e-3);
}

// kappa = sqrt(3)/2 kb from the cylinder: E/(A kb C^2) = 0.4330127 (analytic, spring_network table of the reference
// data).
TEST(Bending, CylinderGivesKappa) {
    constexpr double radius = 200, kb = 3;
    for (const double axis : {0.0, 0.3, std::numbers::pi / 2}) {
        const double perCell = testing::bulk([&](const Mesh& flat) {
            Network network(flat.nodes, flat.triangles);
            DihedralBending law;
            law.k = kb;
            const auto term = law.makeTerm(network, {});
            std::vector<Vec3> x;
            for (const Vec3& p : flat.nodes) {
                const double along = p.x() * std::cos(axis) + p.y() * std::sin(axis),
                             arc = p.y() * std::cos(axis) - p.x() * std::sin(axis);
                x.emplace_back(along, radius * std::sin(arc / radius), radius * std::cos(arc / radius));
            }
            return term->energy(x);
        });
        EXPECT_NEAR(perCell / testing::hexagonalCell * radius * radius / kb, 0.4330127018922193, 4e-4);
    }
}

// Sum of 1 - cos(theta), area and volume of icospheres: analytic, computed with 12 digits (spring_network table of
// the reference data). The limit for kb = 2/sqrt(3) kappa would be 8 pi kappa/3; an icosphere is 3.4 % above it.
TEST(Bending, IcosphereAgreesWithTheReference) {
    struct Row {
        int level;
        double oneMinusCos, overSphere, area, volume;
    };
    for (const Row& row : {Row{1, 7.496815133600569, 0.3444342338991147, 0.928345323381442, 0.8734532000030634},
                           Row{2, 7.485433388676952, 0.34391131016105553, 0.9811781757531297, 0.9661607485985872},
                           Row{3, 7.49948865529328, 0.34455706637925876, 0.9952350696770933, 0.9913938426297549}}) {
        const Mesh mesh = testing::icosphere(row.level);
        Network network(mesh.nodes, mesh.triangles);
        network.useHinges();
        EXPECT_EQ(network.hinges().size(), network.bonds().size());
        const Harmonic spring{DihedralBending::springPerModulus()};  // kappa = 1
        double oneMinusCos = 0, harmonic = 0, area = 0, volume = 0;
        for (const Hinge& hinge : network.hinges()) {
            EXPECT_GT(hinge.rest, 0);
            oneMinusCos += 1 - std::cos(hinge.rest);
            harmonic += spring.energy(hinge.rest, 0);
        }
        for (const Index3& t : mesh.triangles) {
            area += areaVector(mesh.nodes, t).norm();
            volume += tetrahedron(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]], Vec3(0.1, 0.2, 0.3));
        }
        EXPECT_NEAR(oneMinusCos, row.oneMinusCos, 1e-11);
        EXPECT_NEAR(harmonic / (8 * std::numbers::pi), row.overSphere, row.overSphere * 0.2 / (1 << (2 * row.level)));
        EXPECT_NEAR(area / (4 * std::numbers::pi), row.area, 1e-12);
        EXPECT_NEAR(volume / (4 * std::numbers::pi / 3), row.volume, 1e-12);
    }
}

TEST(Bending, ConstantFromEachOfItsThreeForms) {
    DihedralBending law;
    law.Eb = 0.01;
    EXPECT_NEAR(law.bendingModulus({2.165e-4, 4e-6}), 0.01 * 2.165e-4 * 16e-12, 1e-26);
    law.Eb.reset();
    law.kappa = 2.8e-19;
    EXPECT_EQ(law.bendingModulus({}), 2.8e-19);
    law.kappa.reset();
    law.k = 1e-20;
    EXPECT_NEAR(law.bendingModulus({}), 0.8660254037844386e-20, 1e-32);
}

}  // namespace
}  // namespace corpuscle::membrane
