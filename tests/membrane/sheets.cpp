// Flat sheets under the protocols uniaxial, equibiaxial and shear: tension against the closed formulas of the laws, on
// a regular and an irregular mesh.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/flatSheet.hpp"
#include "membrane/neoHookean.hpp"
#include "membrane/protocol.hpp"
#include "membrane/skalak.hpp"
#include "settingsText.hpp"

namespace corpuscle::membrane {
namespace {

constexpr double G = 1.3, C = 2;  // N/m

// Cauchy tensions, N/m. Uniaxial: at the width that is free of lateral tension.
struct Formulas {
    const char* laws;
    double (*width)(double l);
    double (*uniaxial)(double l);
    double (*equibiaxial)(double l);
    double (*shear)(double g);
};

double skalakWidth(double l) { return std::sqrt((1 + C * l * l) / (1 + C * l * l * l * l)); }

const Formulas formulas[] = {{"{triangles: {type: neoHookean, Gs: 1.3 N/m}}", [](double l) { return 1 / std::sqrt(l); },
                              [](double l) { return G * (l - 1 / (l * l)) * std::sqrt(l); },
                              [](double l) { return G * (1 - std::pow(l, -6)); }, [](double g) { return G * g; }},
                             {"{triangles: {type: skalak, Gs: 1.3 N/m, C: 2}}", skalakWidth,
                              [](double l) {
                                  const double w = skalakWidth(l);
                                  return G * l * (l * l - 1 + C * w * w * (l * l * w * w - 1)) / w;
                              },
                              [](double l) { return G * (l * l - 1 + C * l * l * (std::pow(l, 4) - 1)); },
                              [](double g) { return G * (g + g * g * g); }}};

class Sheets : public ::testing::TestWithParam<double> {  // disorder in edges
  protected:
    static std::vector<double> rowOf(const Protocol& protocol, int stage, Membrane& sheet) {
        const EquilibriumReport report =
            findEquilibrium(sheet, protocol.apply(stage, sheet), {.tolerance = 1e-11, .forceScale = 1});
        EXPECT_TRUE(report.converged) << report.residual;
        return protocol.measure(stage, sheet);
    }
    Membrane sheetOf(const char* laws) const {
        geometry::TriangleMesh mesh = geometry::rectangle(3, 2, 0.25);
        geometry::disorder(mesh, GetParam(), 5);
        return {"sheet", 1, mesh.nodes, mesh.triangles, testing::parsed<MembraneSettings>(laws), 1};
    }
};

TEST_P(Sheets, AnswerAsTheirLawsSay) {
    const auto uniaxial = testing::chosen<Protocol>("{type: uniaxial, stretches: [0.9, 1.3, 1.7]}");
    const auto equibiaxial = testing::chosen<Protocol>("{type: equibiaxial, stretches: [0.9, 1.3, 1.7]}");
    const auto shear = testing::chosen<Protocol>("{type: shear, amounts: [0.4, 0.8]}");
    for (const Formulas& law : formulas) {
        Membrane sheet = sheetOf(law.laws);
        for (int stage = 0; stage < uniaxial->stages(); ++stage) {
            const std::vector<double> row = rowOf(*uniaxial, stage, sheet);
            EXPECT_NEAR(row[2], law.width(row[0]), 1e-9) << law.laws;
            EXPECT_NEAR(row[3], law.uniaxial(row[0]), 1e-9) << law.laws;
            EXPECT_NEAR(row[4], 0, 1e-9);
            EXPECT_NEAR(row[5], 0, 1e-9);
        }
        for (int stage = 0; stage < equibiaxial->stages(); ++stage) {
            const std::vector<double> row = rowOf(*equibiaxial, stage, sheet);
            EXPECT_NEAR(row[3], law.equibiaxial(row[0]), 1e-9) << law.laws;
            EXPECT_NEAR(row[4], row[3], 1e-9);
        }
        for (int stage = 0; stage < shear->stages(); ++stage) {
            const std::vector<double> row = rowOf(*shear, stage, sheet);
            EXPECT_NEAR(row[5], law.shear(row[0]), 1e-9) << law.laws;
            EXPECT_NEAR(row[2], 1, 1e-12);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(RegularAndIrregular, Sheets, ::testing::Values(0.0, 0.2));

// A sheet of harmonic bonds has the tension of the stretched infinite lattice, 2/sqrt(3) k sum over its bonds, except
// for bonds on the border, which belong to one triangle instead of two; so the error decreases with the size of the
// sheet.
TEST(Sheet, OfBondsComesToItsLatticeWithTheSizeOfTheSheet) {
    const auto equibiaxial = testing::chosen<Protocol>("{type: equibiaxial, stretches: [1.2]}");
    double error = 1;
    for (const double size : {3.0, 6.0, 12.0}) {
        const geometry::TriangleMesh mesh = geometry::rectangle(size, std::sqrt(0.75) * size, 0.5);
        Membrane sheet("sheet", 1, mesh.nodes, mesh.triangles,
                       testing::parsed<MembraneSettings>("{bonds: {type: harmonic, k: 2 N/m}}"), 1);
        ASSERT_TRUE(
            findEquilibrium(sheet, equibiaxial->apply(0, sheet), {.tolerance = 1e-11, .forceScale = 1}).converged);
        const double exact = std::sqrt(3.0) * 2 * 0.2 / 1.2;  // sqrt(3) k (l - 1)/l
        const double now = std::abs(equibiaxial->measure(0, sheet)[3] / exact - 1);
        EXPECT_LT(now, 0.6 * error);
        error = now;
    }
    EXPECT_LT(error, 0.05);
}

TEST(Sheet, ProtocolsRefuseWhatIsNone) {
    const geometry::TriangleMesh mesh = geometry::disc(1, 0.3);
    std::vector<Vec3> bent = mesh.nodes;
    for (Vec3& x : bent) {
        x[2] = 0.1 * x[0];
    }
    Membrane sheet("sheet", 1, bent, mesh.triangles,
                   testing::parsed<MembraneSettings>("{bonds: {type: harmonic, k: 2 N/m}}"), 1);
    EXPECT_THROW(testing::chosen<Protocol>("{type: shear, amounts: [0.1]}")->apply(0, sheet), Failure);
    EXPECT_THROW(testing::chosen<Protocol>("{type: shear, amounts: []}"), CaseError);
    EXPECT_THROW(testing::chosen<Protocol>("{type: uniaxial, stretches: []}"), CaseError);
    EXPECT_THROW(testing::chosen<Protocol>("{type: equibiaxial, stretches: [0]}"), CaseError);
}

}  // namespace
}  // namespace corpuscle::membrane
