// The meaning of absent and automatic keys, combinations that schemes reject, and predicted step lengths.
#include <cmath>

#include "numerics.hpp"
#include "schemes/cost.hpp"
#include "support/planeWalls.hpp"

namespace corpuscle::schemes {
namespace {

std::string problemsOf(const WrittenNumerics& n, const std::string& integrator) {
    Problems problems;
    check(n.settled(integrator), n.settings, n.facts, problems);
    try {
        problems.throwIfAny();
    } catch (const CaseError& error) {
        std::string all;
        for (const Problem& p : error.problems()) all += p.key + ": " + p.message + "\n";
        return all;
    }
    return "";
}

TEST(Choice, whatAbsentKeysStandFor) {
    struct Row {
        const char* integrator;
        bool cells, bodies;
        const char *coupling, *operators;
        bool adjoint;
    };
    for (const Row& row : {Row{"velocityVerlet", false, false, "immersed", "plain", false},
                           Row{"velocityVerlet", true, false, "immersed", "corrected", true},
                           Row{"velocityVerlet", false, true, "dualIdentity", "plain", false},
                           Row{"velocityVerlet", true, true, "dualIdentity", "plain", false},
                           Row{"rkl2", false, false, "immersed", "plain", false},
                           Row{"implicit", false, false, "immersed", "corrected", true},
                           Row{"implicit", true, true, "immersed", "corrected", true}}) {
        WrittenNumerics n("");
        n.facts.hasCells = row.cells, n.facts.hasBodies = row.bodies;
        const NumericsSettings s = n.settled(row.integrator);
        const std::string where =
            std::string(row.integrator) + (row.cells ? " cells" : "") + (row.bodies ? " bodies" : "");
        EXPECT_EQ(s.coupling, row.coupling) << where;
        EXPECT_EQ(s.operators, row.operators) << where;
        EXPECT_EQ(s.scheme->traits().isAdjoint, row.adjoint) << where;
        EXPECT_EQ(s.shifting.has_value(), s.isCorrected()) << where;
        EXPECT_DOUBLE_EQ(s.support(), s.isCorrected() ? 2.4e-6 : 3.0e-6) << where;
        EXPECT_EQ(problemsOf(n, row.integrator), "") << where;
    }
}

TEST(Choice, writtenKeysStay) {
    WrittenNumerics n(
        "coupling: dualIdentity\noperators: plain\nkernel: {type: wendlandC2, support: 2.8 dx}\nimplicit: {step: "
        "0.2}\n");
    n.facts.hasCells = true;
    n.facts.flow.transient = 1, n.facts.flow.rate = 1;  // a fortieth of it: 0.025
    const NumericsSettings verlet = n.settled("velocityVerlet"), implicit = n.settled("implicit");
    EXPECT_EQ(verlet.coupling, "dualIdentity");
    EXPECT_FALSE(verlet.scheme->traits().isAdjoint);
    EXPECT_DOUBLE_EQ(verlet.support(), 2.8e-6);
    EXPECT_DOUBLE_EQ(implicit.scheme->fullStep(n.facts, 0), 0.2);
    WrittenNumerics absent("");
    absent.facts.flow.transient = 1, absent.facts.flow.rate = 1;
    const NumericsSettings followed = absent.settled("implicit");
    EXPECT_DOUBLE_EQ(followed.scheme->fullStep(absent.facts, 0), 0.025);
    EXPECT_EQ(write(followed).find("implicit")->find("step")->scalar, "0.025");  // as written to used.yaml
    EXPECT_EQ(write(absent.settings).find("implicit")->find("step")->scalar, "0.05");
    // A start-up is not followed in a run that is more than 100 times as long.
    absent.facts.flow.settles = true, absent.facts.duration = 99;
    EXPECT_DOUBLE_EQ(absent.settled("implicit").scheme->fullStep(absent.facts, 0), 0.025);
    absent.facts.duration = 101;
    EXPECT_DOUBLE_EQ(absent.settled("implicit").scheme->fullStep(absent.facts, 0), 0.05);
}

TEST(Choice, whoRefusesWhat) {
    const auto refused = [](const std::string& keys, const std::string& integrator, bool cells, bool bodies,
                            const std::string& reason) {
        WrittenNumerics n(keys);
        n.facts.hasCells = cells, n.facts.hasBodies = bodies;
        EXPECT_NE(problemsOf(n, integrator).find(reason), std::string::npos)
            << integrator << ": " << problemsOf(n, integrator);
    };
    refused("", "rkl2", true, false, "integrator: found rkl2, which is for a fluid alone");
    refused("", "rkl2", false, true, "system/mesh.yaml has bodies");
    refused("operators: corrected\n", "rkl2", false, false, "which 'integrator: rkl2' does not have");
    refused("coupling: dualIdentity\n", "implicit", true, false, "coupling: found dualIdentity");
    refused("coupling: dualIdentity\noperators: corrected\n", "velocityVerlet", true, false,
            "write that, or operators: plain");
    refused("operators: corrected\nshifting: none\n", "velocityVerlet", true, false, "let particles clump");
    refused("operators: corrected\nshifting: none\n", "implicit", false, false, "let particles clump");
    refused("operators: corrected\n", "velocityVerlet", false, true,
            "integrator: velocityVerlet' moves with 'operators: plain'");
    refused("guard: 5\n", "velocityVerlet", true, false,
            "guard: found 5, which means nothing with 'coupling: immersed'");
    refused("safety: 0.5\nskin: 0.2 dx\n", "implicit", true, false, "skin: found 0.2 dx, which means nothing");
    refused("shifting: {steps: 3}\n", "implicit", true, false, "shifting.steps: found 3");
    refused("operators: corrected\nshifting: none\n", "automatic", true, true, "no integrator can do this case");
    WrittenNumerics layered("");
    layered.facts.largestViscosity = 0.021;
    EXPECT_NE(problemsOf(layered, "implicit").find("at a jump of at most 20"), std::string::npos);
    EXPECT_EQ(problemsOf(layered, "velocityVerlet"), "");
}

TEST(Choice, tableOfAScheme) {
    EXPECT_THROW(WrittenNumerics("rkl2: {stages: 4}\n"), CaseError);
    EXPECT_THROW(WrittenNumerics("implicit: {stage: 5}\n"), CaseError);
    EXPECT_THROW(WrittenNumerics("implicit: {type: midpoint}\n"), CaseError);
    EXPECT_THROW(WrittenNumerics("velocityVerlet: {}\n"), CaseError);  // it has no settings
    EXPECT_THROW(WrittenNumerics("integrator: euler\n"), CaseError);
}

// mu = 1 mPa s, dx = 1 um, Wendland C2 of 3 dx: H_s/2 = 1.5 um; c0 + U = 0.101 m/s.
TEST(Choice, predictedLimits) {
    WrittenNumerics n("safety: 0.5\n");
    n.flow(100, 1e-3);
    const NumericsSettings s = n.settled("velocityVerlet");
    const sph::StepLimits limits = s.scheme->limits(n.facts, s, 0);
    ASSERT_EQ(limits.all.size(), 2u);
    EXPECT_NEAR(limits.all[0].seconds, 0.5 / (s.kernel->viscousRate(3) * 1e6), 1e-12 * limits.all[0].seconds);
    EXPECT_NEAR(limits.all[1].seconds, 0.25 * 1.5e-6 / 0.101, 1e-12 * limits.all[1].seconds);
    EXPECT_EQ(limits.binding().name, "viscous");
    n.facts.flow.walls = boundary::testing::planes(2, 0, 1);
    const NumericsSettings implicit = n.settled("implicit");
    EXPECT_DOUBLE_EQ(implicit.scheme->limits(n.facts, implicit, 0).binding().seconds, 5e-4);
}

TEST(Choice, theCheapestThatCan) {
    WrittenNumerics n("");
    n.flow(100, 0.05);
    std::vector<IntegratorCost> costs = predictCosts(n.settings, n.facts);
    EXPECT_EQ(cheapest(costs), "implicit");
    for (const IntegratorCost& cost : costs) {
        EXPECT_EQ(cost.whyNot, "");
        // All steps have the same length, so their number is the time over the step.
        if (cost.name != "rkl2") {
            EXPECT_NEAR(cost.steps, 0.05 / cost.step().seconds, 1e-9 * cost.steps) << cost.name;
        }
    }
    n.facts.hasCells = true, n.facts.largestViscosity = 1;  // no adjoint operators, no rkl2
    WrittenNumerics none("");
    EXPECT_EQ(cheapest({}), "");
    costs = predictCosts(n.settings, n.facts);
    for (const IntegratorCost& cost : costs) EXPECT_NE(cost.whyNot, "") << cost.name;
    EXPECT_EQ(cheapest(costs), "");
}

}  // namespace
}  // namespace corpuscle::schemes
