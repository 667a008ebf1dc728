// Pore laws: passage through pores against limits and a numerical solution, shares against closed forms, times.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "membrane/diagnostics.hpp"
#include "ruptureCases.hpp"

namespace corpuscle::membrane {
namespace {

using namespace testing;

struct AnyPores final : PoreLaw {
    AnyPores(double r, double L) { radius = r, length = L; }
    std::vector<double> atRest(const Network&, const MembraneSettings&, std::span<const Vec3>) const override {
        return {};
    }
};

constexpr double D = 6e-11, mu = 1e-3, nm = 1e-9, share = 0.01;

double hindered(double l) {
    return std::pow(1 - l, 2) * (1 - 2.104 * l + 2.09 * std::pow(l, 3) - 0.95 * std::pow(l, 5));
}

// A point molecule meets the pore as a tube, D/L, and two mouths, each of the conductance 4 D r.
TEST(Pores, PermeabilityOfTubesAndMouths) {
    const PoreSolute point{0, D, mu};
    EXPECT_NEAR(AnyPores(10 * nm, 1e5 * nm).permeability(share, point) / (share * D / (1e5 * nm)), 1, 2e-4);
    const double r = 10 * nm, perArea = share / (std::numbers::pi * r * r);
    EXPECT_NEAR(AnyPores(r, 1e-6 * nm).permeability(share, point) / (perArea * 2 * D * r), 1, 1e-6);
}

// Renkin's factor, A/A0 of his table: molecules of 0.1, 0.3 and 0.5 of the pore's radius.
TEST(Pores, MoleculesAreHindered) {
    for (const double l : {0.1, 0.3, 0.5}) {
        const PoreSolute solute{l * 10 * nm, D, mu};
        const double P = AnyPores(10 * nm, 1e5 * nm).permeability(share, solute);
        EXPECT_NEAR(P / (share * D / (1e5 * nm)), hindered(l), 1e-4);
    }
    EXPECT_NEAR(hindered(0.1), 0.641, 2e-3);
    EXPECT_NEAR(hindered(0.5), 0.045, 1e-3);
    EXPECT_EQ(AnyPores(3 * nm, 8 * nm).permeability(share, {3.2 * nm, D, mu}), 0);
    EXPECT_EQ(AnyPores(3 * nm, 8 * nm).flux(share, 1e3, {3.2 * nm, D, mu}).outward, 0);
}

// Sampson's orifice, Q = r^3 dp/(3 mu), and Poiseuille's tube, Q = pi r^4 dp/(8 mu L).
TEST(Pores, FlowOfOrificesAndTubes) {
    const double r = 10 * nm, dp = 300, perArea = share / (std::numbers::pi * r * r);
    EXPECT_NEAR(AnyPores(r, 1e-6 * nm).flow(share, dp, mu) / (perArea * r * r * r * dp / (3 * mu)), 1, 1e-6);
    const double L = 1e5 * nm;
    EXPECT_NEAR(AnyPores(r, L).flow(share, dp, mu) / (perArea * std::numbers::pi * std::pow(r, 4) * dp / (8 * mu * L)),
                1, 2e-4);
}

// The flux against the steady profile of concentration in a layer, found by finite volumes with the same P and q.
TEST(Pores, FluxAgainstProfileInTheLayer) {
    const AnyPores pores(10 * nm, 8 * nm);
    const PoreSolute solute{3.2 * nm, D, mu};
    const double P = pores.permeability(share, solute), phi = std::pow(1 - 0.32, 2);
    const double sieved = phi * (2 - phi) * (1 - 2.0 / 3 * 0.32 * 0.32 - 0.163 * std::pow(0.32, 3));
    for (const double dp : {-2000.0, -10.0, 0.0, 1e-7, 300.0, 5000.0}) {
        const double carried = sieved * pores.flow(share, dp, mu), in = 300, out = 20;
        constexpr int n = 2000;  // c_0 = in, c_n = out; the flux between neighbours is the same everywhere
        const double a = carried / 2 + P * n, b = carried / 2 - P * n;  // J = a c_k + b c_k+1
        // c_k+1 = (J - a c_k)/b is linear in J: find the J that ends at `out`.
        double c0 = in, c1 = in;
        const auto end = [&](double c, double J) {
            for (int k = 0; k < n; ++k) c = (J - a * c) / b;
            return c;
        };
        const double J0 = 0, J1 = P * (in - out) + carried * in;
        c0 = end(in, J0), c1 = end(in, J1);
        const double J = J0 + (out - c0) * (J1 - J0) / (c1 - c0);
        const PoreFlux flux = pores.flux(share, dp, solute);
        EXPECT_NEAR(flux.outward * in - flux.inward * out, J, 2e-5 * std::abs(J1)) << dp;
        EXPECT_GE(flux.outward, 0);
        EXPECT_GE(flux.inward, 0);
    }
    const PoreFlux still = pores.flux(share, 0, solute);
    EXPECT_DOUBLE_EQ(still.outward, P);
    EXPECT_DOUBLE_EQ(still.inward, P);
    const PoreFlux fast = pores.flux(share, 1e9, solute);
    EXPECT_NEAR(fast.outward / (sieved * pores.flow(share, 1e9, mu)), 1, 1e-12);
    EXPECT_NEAR(fast.inward, 0, 1e-12);
}

TEST(Pores, ShareOfExcessAreaOnAStrainedSheet) {
    for (const auto& [a, b] : {std::pair{1.01, 1.005}, {1.05, 1.02}, {1.3, 1.1}}) {
        Membrane sheet = strainedSheet(
            "{triangles: {type: neoHookean, Gs: 1 N/m}, pores: {type: excessArea, onset: 0.03, share: 0.4, radius: 10 "
            "nm}}",
            a, b);
        sheet.openPores(1e-3);
        const double expected = 0.4 * std::max(0.0, 1 - 1.03 / (a * b));
        for (const double phi : sheet.pores()) EXPECT_NEAR(phi, expected, 1e-12);
        EXPECT_NEAR(sheet.poreArea(), expected * sheet.area(), 1e-12 * sheet.area());
    }
}

// The area law alone bears the isotropic tension k (A/A0 - 1); a sheet law adds half the trace of its tension.
TEST(Pores, ShareOfTensionOnAStrainedSheet) {
    const double a = 1.04, b = 1.03, e = a * b - 1;
    Membrane sheet = strainedSheet(
        "{triangles: {type: neoHookean, Gs: 1 N/m}, area: {local: 5 N/m}, pores: {type: tension, onset: "
        "0.2 N/m, modulus: 3 N/m, radius: 10 nm}}",
        a, b);
    const PrincipalTensions tensions = principalTensions(sheet.network(), sheet.laws(), sheet.position);
    const double T = 0.5 * (tensions.tension1[0] + tensions.tension2[0]) + 5 * e;
    sheet.openPores(0);
    ASSERT_GT(T, 0.2);
    for (const double phi : sheet.pores()) EXPECT_NEAR(phi, (T - 0.2) / 3, 1e-9);
}

// A sphere whose area alone is held bears the tension k (A/A0 - 1) everywhere: Laplace's pressure 2 T/R.
TEST(Pores, PressureOfASphereUnderTension) {
    Problems problems;
    const auto laws = read<MembraneSettings>(
        parseValue("{bonds: {type: harmonic, k: 1e-9 N/m}, area: {global: 3 N/m}}", "test", problems), problems);
    problems.throwIfAny();
    Membrane sphere = membraneOf(icosphere(4), laws);
    for (Vec3& x : sphere.position) x *= 1.02;
    sphere.computeForces();
    const double expected = 2 * 3 * (1.02 * 1.02 - 1) / 1.02;
    const std::vector<double> all = heldPressures(sphere.network(), sphere.position, sphere.force);
    double sum = 0;
    for (const double p : all) {
        EXPECT_NEAR(p / expected, 1, 0.025);  // the twelve nodes with five neighbours are off
        sum += p;
    }
    EXPECT_NEAR(sum / static_cast<double>(all.size()) / expected, 1, 0.003);
}

// Opening and resealing take their times, in one step as in many; at once without a time.
TEST(Pores, OpenAndResealInTheirTimes) {
    const std::string law =
        "{triangles: {type: neoHookean, Gs: 1 N/m}, pores: {type: excessArea, onset: 0, radius: 10 nm, opening: 1 ms, "
        "resealing: 10 ms}}";
    Membrane once = strainedSheet(law, 1.1, 1), often = strainedSheet(law, 1.1, 1);
    const double full = 1 - 1 / 1.1, opened = full * (1 - std::exp(-2.0));
    once.openPores(2e-3);
    for (int k = 0; k < 200; ++k) often.openPores(1e-5);
    EXPECT_NEAR(once.pores()[0], opened, 1e-12);
    EXPECT_NEAR(often.pores()[0], opened, 1e-12);
    for (Vec3& x : once.position) x.x() /= 1.1;
    once.openPores(5e-3);
    EXPECT_NEAR(once.pores()[0], opened * std::exp(-0.5), 1e-12);
    Membrane soon = strainedSheet(
        "{triangles: {type: neoHookean, Gs: 1 N/m}, pores: {type: excessArea, onset: 0, radius: 10 nm}}", 1.1, 1);
    soon.openPores(1e-9);
    EXPECT_NEAR(soon.pores()[0], full, 1e-12);
    for (Vec3& x : soon.position) x.x() /= 1.1;
    soon.openPores(0);
    EXPECT_NEAR(soon.pores()[0], 0, 1e-12);
}

TEST(Pores, AreNoneInATornMembrane) {
    Membrane sheet = strainedSheet(
        "{triangles: {type: neoHookean, Gs: 1 N/m}, pores: {type: excessArea, onset: 0, radius: 10 nm}, rupture: "
        "{type: "
        "bondStretch, limit: 1.05}}",
        1.04, 1);
    sheet.openPores(0);
    EXPECT_GT(sheet.poreArea(), 0);
    for (Vec3& x : sheet.position) x.x() *= 1.05;
    ASSERT_FALSE(breakNow(sheet).empty());
    sheet.openPores(0);
    EXPECT_EQ(sheet.pores(), std::vector<double>(sheet.network().nodeCount(), 0.0));
}

TEST(Pores, RestoreTheirState) {
    const std::string law =
        "{triangles: {type: neoHookean, Gs: 1 N/m}, pores: {type: excessArea, onset: 0, radius: 10 nm}}";
    Membrane sheet = strainedSheet(law, 1.1, 1), other = strainedSheet(law, 1, 1);
    sheet.openPores(0);
    other.restore(sheet.network().aliveBonds(), {}, sheet.pores());
    EXPECT_EQ(other.pores(), sheet.pores());
    other.restore(sheet.network().aliveBonds());  // a checkpoint of a membrane without pores
    EXPECT_EQ(other.pores(), std::vector<double>(sheet.pores().size(), 0.0));
    EXPECT_TRUE(strainedSheet("{triangles: {type: neoHookean, Gs: 1 N/m}}", 1.1, 1).pores().empty());
}

}  // namespace
}  // namespace corpuscle::membrane
