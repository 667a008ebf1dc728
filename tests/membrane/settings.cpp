// An entry of constant/membranes.yaml.
#include <gtest/gtest.h>

#include "membrane/bondStretch.hpp"
#include "membrane/dihedralBending.hpp"
#include "membrane/harmonicBond.hpp"
#include "membrane/helfrichBending.hpp"
#include "membrane/membraneSettings.hpp"
#include "support/registered.hpp"

namespace corpuscle::membrane {
namespace {

MembraneSettings parse(const std::string& text, Problems& problems) {
    return read<MembraneSettings>(parseDictionary(text, "constant/membranes.yaml", problems), problems);
}

std::string problemsOf(const std::string& text) {
    Problems problems;
    parse(text, problems);
    try {
        problems.throwIfAny();
    } catch (const CaseError& error) {
        return error.what();
    }
    return "";
}

TEST(MembraneSettings, TheMainTutorialsCell) {
    Problems problems;
    const MembraneSettings s = parse(
        "interior: {viscosityRatio: 5}\n"
        "bonds: {type: harmonic, k: 5e-4 N/m}\n"
        "angles: {type: harmonic, k: 1e-20 J}\n"
        "bending: {type: dihedral, Eb: 0.01}\n"
        "rupture: {type: bondStretch, limit: 1.05}\n",
        problems);
    ASSERT_NO_THROW(problems.throwIfAny());
    EXPECT_EQ(s.interior.viscosityRatio, 5);
    EXPECT_NEAR(s.bonds->hexagonalModuli(1).shear, 2.165e-4, 1e-7);
    EXPECT_TRUE(s.angles);
    EXPECT_NEAR(s.bending->bendingModulus({s.bonds->hexagonalModuli(1).shear, 4e-6}), 3.5e-17, 0.05e-17);
    EXPECT_EQ(dynamic_cast<const BondStretch&>(*s.rupture).limit, 1.05);
}

TEST(MembraneSettings, BondsAloneAreEnough) {
    Problems problems;
    const MembraneSettings s = parse("bonds: {type: harmonic, k: 5e-4 N/m}\nrupture: none\n", problems);
    ASSERT_NO_THROW(problems.throwIfAny());
    EXPECT_EQ(s.interior.viscosityRatio, 1);
    EXPECT_FALSE(s.angles);
    EXPECT_FALSE(s.bending);
    EXPECT_FALSE(s.rupture);
}

TEST(MembraneSettings, TrianglesInPlaceOfBondsOrBesideThem) {
    Problems problems;
    const MembraneSettings s = parse("triangles: {type: skalak, Gs: 5e-6 N/m, Ks: 1.05e-4 N/m}\n", problems);
    ASSERT_NO_THROW(problems.throwIfAny());
    EXPECT_FALSE(s.bonds);
    EXPECT_NEAR(s.moduli(1).shear, 5e-6, 1e-18);
    EXPECT_NEAR(s.moduli(1).area, 1.05e-4, 1e-16);  // C = 10
    const MembraneSettings both = parse(
        "bonds: {type: wlcPow, Gs: 1e-6 N/m, x0: 0.45, scaled: true}\n"
        "triangles: {type: lattice, k: 5e-4 N/m}\n"
        "area: {local: 1e-4 N/m, global: 2e-4 N/m}\n",
        problems);
    ASSERT_NO_THROW(problems.throwIfAny());
    EXPECT_TRUE(both.bonds->scaled);
    EXPECT_NEAR(both.moduli(1).shear, 1e-6 + 2.165063509461e-4, 1e-15);
    EXPECT_NEAR(both.moduli(1).area, 2e-6 + 4.330127018922e-4 + 3e-4, 1e-15);
}

TEST(MembraneSettings, ViscosityThatThins) {
    Problems problems;
    const MembraneSettings s = parse(
        "bonds: {type: harmonic, k: 5e-4 N/m}\n"
        "viscosity: {shear: 0.5 uN s/m, thinning: {rate: 2 1/s, index: 0.3}}\n",
        problems);
    ASSERT_NO_THROW(problems.throwIfAny());
    EXPECT_EQ(s.viscosity->dilatation, 0);
    EXPECT_NEAR(s.viscosity->shearAt(0), 5e-7, 1e-20);
    EXPECT_NEAR(s.viscosity->shearAt(200), 5e-7 * std::pow(100, -0.7), 1e-11);
    const std::string said = problemsOf(
        "bonds: {type: harmonic, k: 1 N/m}\nviscosity: {shear: 1 N s/m, thinning: {rate: 0 1/s, index: 1.2}}\n");
    EXPECT_NE(said.find("rate: "), std::string::npos) << said;
    EXPECT_NE(said.find("index: "), std::string::npos) << said;
}

TEST(MembraneSettings, HelfrichAreaAndVolume) {
    Problems problems;
    const MembraneSettings s = parse(
        "bonds: {type: harmonic, k: 5e-6 N/m}\n"
        "bending: {type: helfrich, kappa: 2e-19 J, spontaneousCurvature: -2e6 1/m, areaDifference: {ratio: 0.6, "
        "absolute: 1.2 um^2, thickness: 3 nm}}\n"
        "area: {local: 2 uN/m, global: 0.5 mN/m, rest: 130 um^2}\n"
        "volume: {modulus: 10 Pa, reducedVolume: 0.6}\n",
        problems);
    ASSERT_NO_THROW(problems.throwIfAny());
    const auto& law = dynamic_cast<const HelfrichBending&>(*s.bending);
    EXPECT_EQ(law.spontaneousCurvature, -2e6);
    EXPECT_NEAR(*law.areaDifference->absolute, 1.2e-12, 1e-26);
    EXPECT_NEAR(*s.area->rest, 130e-12, 1e-24);
    EXPECT_EQ(*s.volume->reducedVolume, 0.6);
}

TEST(MembraneSettings, FaultsAreNamed) {
    EXPECT_NE(problemsOf("bonds: {type: harmonc, k: 5e-4 N/m}\n").find("harmonic"), std::string::npos);
    EXPECT_NE(problemsOf("bonds: {type: harmonic, k: 5e-4}\n"), "");
    EXPECT_NE(problemsOf("bonds: {type: harmonic, k: -5e-4 N/m}\n"), "");
    EXPECT_NE(problemsOf("bending: {type: dihedral, Eb: 0.01}\n").find("bonds"), std::string::npos);
    EXPECT_NE(problemsOf("angles: {type: harmonic, k: 1e-20 J}\n").find("triangles (lattice, linear"),
              std::string::npos);
    EXPECT_NE(problemsOf("triangles: {type: skalak, Gs: 5e-6 N/m}\n").find("Ks"), std::string::npos);
    EXPECT_NE(problemsOf("triangles: {type: neohookean, Gs: 5e-6 N/m}\n").find("neoHookean"), std::string::npos);
    EXPECT_NE(problemsOf("bonds: {type: wlcPow, x0: 0.45}\n").find("persistenceLength"), std::string::npos);
    EXPECT_NE(problemsOf("bonds: {type: fenePow, Gs: 1e-6 N/m, x0: 1}\n").find("x0"), std::string::npos);
    const std::string bonds = "bonds: {type: harmonic, k: 5e-4 N/m}\n";
    EXPECT_NE(problemsOf(bonds + "bending: {type: dihedral, Eb: 0.01, k: 1e-20 J}\n").find("Eb"), std::string::npos);
    EXPECT_NE(problemsOf(bonds + "bending: dihedral\n").find("kappa"), std::string::npos);
    EXPECT_NE(problemsOf(bonds + "rupture: {type: bondStretch, limit: 1}\n"), "");
    EXPECT_NE(problemsOf(bonds + "rupture: {type: damage, scale: 0.02}\n").find("time to failure"), std::string::npos);
    EXPECT_NE(problemsOf(bonds + "rupture: {type: damage, scale: 0.02, time: 1e-3}\n").find("unit"), std::string::npos);
    EXPECT_NE(problemsOf(bonds + "rupture: {type: damage, scale: 0, time: 1 ms}\n").find("greater than 0"),
              std::string::npos);
    EXPECT_NE(problemsOf(bonds + "ruptur: none\n").find("rupture"), std::string::npos);
    EXPECT_NE(problemsOf(bonds + "area: {rest: 130 um^2}\n").find("global"), std::string::npos);
    EXPECT_NE(problemsOf(bonds + "volume: {modulus: 10 Pa, rest: 90 um^3, reducedVolume: 0.6}\n"), "");
    EXPECT_NE(problemsOf(bonds + "volume: {modulus: 10 Pa, reducedVolume: 1.2}\n"), "");
    const std::string helfrich = bonds + "bending: {type: helfrich, kappa: 2e-19 J, ";
    EXPECT_NE(problemsOf(helfrich + "areaDifference: {ratio: 0.6}}\n").find("reduced"), std::string::npos);
    EXPECT_NE(problemsOf(helfrich + "areaDifference: {ratio: 0.6, absolute: 1.2 um^2}}\n").find("thickness"),
              std::string::npos);
    EXPECT_NE(problemsOf(helfrich + "spontaneousCurvature: 0.5}\n"), "");
}

TEST(Registry, EveryLawOfThisLibraryIsThere) {
    using corpuscle::support::missing;
    const std::vector<std::string> none;
    EXPECT_EQ(missing<BondLaw>({"fenePow", "harmonic", "wlcPow"}), none);
    EXPECT_EQ(missing<TriangleLaw>({"lattice", "linear", "neoHookean", "skalak"}), none);
    EXPECT_EQ(missing<AngleLaw>({"harmonic"}), none);
    EXPECT_EQ(missing<BendingLaw>({"dihedral", "helfrich"}), none);
    EXPECT_EQ(missing<RuptureLaw>({"arealStrain", "bondStretch", "damage", "tension"}), none);
}

}  // namespace
}  // namespace corpuscle::membrane
