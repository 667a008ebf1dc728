// The damage law of rupture: time to failure, accumulation of damage, limits of the law, its state.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "ruptureCases.hpp"

namespace corpuscle::membrane {
namespace {

using namespace testing;

// Damage at constant strain fails after tau (ec/(e - e0))^n, at the first step at or past it.
TEST(Damage, TimeToFailureAtConstantStrain) {
    const double tau = 1e-3, dt = 1e-6;
    for (const auto& [exponent, stretch] : {std::pair{1.0, 1.05}, {2.5, 1.05}, {2.5, 1.2}, {4.0, 1.08}}) {
        const std::string laws =
            "{triangles: {type: neoHookean, Gs: 1 N/m}, rupture: {type: damage, onset: 0.02, "
            "scale: 0.06, time: 1 ms, exponent: " +
            std::to_string(exponent) + "}}";
        Membrane sheet = strainedSheet(laws, stretch, 1);
        const double expected = tau * std::pow(0.06 / (stretch - 1 - 0.02), exponent);
        long steps = 1;
        while (breakNow(sheet, dt).empty()) {
            ASSERT_LT(++steps, 100000);
        }
        EXPECT_GE(static_cast<double>(steps) * dt, expected * (1 - 1e-9));
        EXPECT_LE(static_cast<double>(steps - 1) * dt, expected * (1 + 1e-9));
        for (const double damage : sheet.damage()) {
            EXPECT_NEAR(damage, 1, 1e-9) << "the same everywhere, and no more than full";
        }
    }
}

// Strain that grows as r t: D = r^n (t - t0)^(n+1)/((n+1) ec^n tau), t0 = e0/r. The sum over steps has an error of
// first order in the step.
TEST(Damage, GathersWithAGrowingStrain) {
    const double rate = 100, onset = 0.02, scale = 0.05, tau = 2e-4, n = 2;
    const double expected =
        onset / rate + std::pow((n + 1) * std::pow(scale, n) * tau / std::pow(rate, n), 1 / (n + 1));
    double error = 0;
    for (const double dt : {4e-6, 2e-6, 1e-6}) {
        Membrane sheet = strainedSheet(
            "{triangles: {type: neoHookean, Gs: 1 N/m}, rupture: {type: damage, onset: 0.02, "
            "scale: 0.05, time: 0.2 ms, exponent: 2}}",
            1, 1);
        const std::vector<Vec3> rest = sheet.position;
        double time = 0;
        do {
            time += dt;
            ASSERT_LT(time, 2 * expected);
            for (std::size_t k = 0; k < rest.size(); ++k) {
                sheet.position[k] = Vec3((1 + rate * time) * rest[k].x(), rest[k].y(), 0);
            }
        } while (breakNow(sheet, dt).empty());
        error = std::abs(time / expected - 1);
        EXPECT_LT(error, 1.01 * dt / expected);
    }
    EXPECT_LT(error, 2e-3);
}

// In both of its limits the law is the threshold law: the same bonds break at the same step with the same stretch,
// throughout a tear.
TEST(Damage, ReducesToTheThreshold) {
    const std::string bonds = "{bonds: {type: harmonic, k: 1 N/m}, rupture: ";
    const auto settings = [&](const std::string& rupture) {
        Problems problems;
        const auto read =
            corpuscle::read<MembraneSettings>(parseValue(bonds + rupture + "}", "test", problems), problems);
        problems.throwIfAny();
        return read;
    };
    const std::string threshold = "{type: arealStrain, limit: 0.0625}";
    const std::string fast = "{type: damage, onset: 0.0625, scale: 0.01, time: 1e-90 s}";
    const std::string steep = "{type: damage, onset: 0.03125, scale: 0.03125, time: 1e-3 s, exponent: 1e12}";
    const Mesh mesh = testing::irregular(2);
    for (const std::string& damage : {fast, steep}) {
        Membrane by = membraneOf(mesh, settings(threshold)), limit = membraneOf(mesh, settings(damage));
        std::vector<Vec3> x = mesh.nodes;
        int first = 0, steps = 25;
        for (int step = 1; step <= steps; ++step) {
            testing::jitter(x, 0.002, 20 + step);
            for (Vec3& p : x) {
                p *= 1.001;
            }
            by.position = limit.position = x;
            const auto expected = breakNow(by), broken = breakNow(limit, 1e-6);
            ASSERT_EQ(broken.size(), expected.size()) << "step " << step << " of " << damage;
            for (std::size_t k = 0; k < broken.size(); ++k) {
                EXPECT_EQ(broken[k].bond, expected[k].bond);
                EXPECT_EQ(broken[k].stretch, expected[k].stretch);
            }
            first = first == 0 && !broken.empty() ? step : first;
        }
        EXPECT_GT(first, 3) << "not at once";
        EXPECT_GT(by.network().brokenBonds(), 20);
        EXPECT_LT(by.network().brokenTriangles(), static_cast<int>(mesh.triangles.size()));
        EXPECT_EQ(limit.network().aliveBonds(), by.network().aliveBonds());
    }
}

// Below the onset no damage accumulates; damage from beyond the onset stays when the strain is gone. A threshold law
// has no damage.
TEST(Damage, IsStateOfTheMembrane) {
    const std::string laws =
        "{triangles: {type: neoHookean, Gs: 1 N/m}, rupture: {type: damage, onset: 0.05, scale: 0.05, time: 1 ms}}";
    Membrane sheet = strainedSheet(laws, 1.05, 0.999);
    EXPECT_TRUE(breakNow(sheet, 1e3).empty());
    EXPECT_EQ(sheet.damage(), std::vector<double>(32, 0.0));
    const std::vector<Vec3> low = sheet.position;
    for (Vec3& x : sheet.position) {
        x = Vec3(1.1 / 1.05 * x.x(), x.y() / 0.999, 0);
    }
    EXPECT_TRUE(breakNow(sheet, 0.6e-3).empty());
    const std::vector<double> kept = sheet.damage();
    EXPECT_NEAR(kept[0], 0.6, 1e-9);
    sheet.position = low;
    EXPECT_TRUE(breakNow(sheet, 1e3).empty());
    EXPECT_EQ(sheet.damage(), kept);

    Membrane restored = strainedSheet(laws, 1.1, 1);
    restored.restore(sheet.network().aliveBonds(), kept);
    EXPECT_EQ(restored.damage(), kept);
    EXPECT_FALSE(breakNow(restored, 0.401e-3).empty());
    EXPECT_THROW(restored.restore(sheet.network().aliveBonds(), {0.5, 0.5}), Failure) << "of another mesh";
    restored.restore(sheet.network().aliveBonds());
    EXPECT_EQ(restored.damage(), std::vector<double>(32, 0.0)) << "a checkpoint of a law that keeps none";
    Membrane threshold = membraneOf(testing::icosphere(1), allLaws());
    threshold.restore(threshold.network().aliveBonds(), kept);
    EXPECT_TRUE(threshold.damage().empty()) << "its law keeps none";
}

}  // namespace
}  // namespace corpuscle::membrane
