// An entry of constant/membranes.yaml.
#include <gtest/gtest.h>

#include "membrane/bondStretch.hpp"
#include "membrane/dihedralBending.hpp"
#include "membrane/harmonicBond.hpp"
#include "membrane/membraneSettings.hpp"

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

TEST(MembraneSettings, FaultsAreNamed) {
    EXPECT_NE(problemsOf("bonds: {type: harmonc, k: 5e-4 N/m}\n").find("harmonic"), std::string::npos);
    EXPECT_NE(problemsOf("bonds: {type: harmonic, k: 5e-4}\n"), "");
    EXPECT_NE(problemsOf("bonds: {type: harmonic, k: -5e-4 N/m}\n"), "");
    EXPECT_NE(problemsOf("bending: {type: dihedral, Eb: 0.01}\n").find("bonds"), std::string::npos);
    const std::string bonds = "bonds: {type: harmonic, k: 5e-4 N/m}\n";
    EXPECT_NE(problemsOf(bonds + "bending: {type: dihedral, Eb: 0.01, k: 1e-20 J}\n").find("Eb"), std::string::npos);
    EXPECT_NE(problemsOf(bonds + "bending: dihedral\n").find("kappa"), std::string::npos);
    EXPECT_NE(problemsOf(bonds + "rupture: {type: bondStretch, limit: 1}\n"), "");
    EXPECT_NE(problemsOf(bonds + "ruptur: none\n").find("rupture"), std::string::npos);
}

TEST(Registry, EveryLawOfThisLibraryIsThere) {
    EXPECT_EQ(Registry<BondLaw>::instance().names(), (std::vector<std::string>{"harmonic"}));
    EXPECT_EQ(Registry<AngleLaw>::instance().names(), (std::vector<std::string>{"harmonic"}));
    EXPECT_EQ(Registry<BendingLaw>::instance().names(), (std::vector<std::string>{"dihedral"}));
    EXPECT_EQ(Registry<RuptureLaw>::instance().names(), (std::vector<std::string>{"bondStretch"}));
}

}  // namespace
}  // namespace corpuscle::membrane
