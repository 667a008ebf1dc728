// Laws of contact: derivatives by central differences, C2 at every joint, settings.
#include <gtest/gtest.h>

#include "contact/barrierMorse.hpp"
#include "core/registry.hpp"
#include "support/registered.hpp"

namespace corpuscle::contact {
namespace {

Barrier barrier() {
    Barrier law;
    law.length = 8e-8, law.strength = 2e-6, law.thickness = 2e-8;
    return law;
}
BarrierMorse attraction() {
    BarrierMorse law;
    law.length = 4e-8, law.strength = 2e-6, law.depth = 1e-7, law.rest = 6e-8, law.decay = 3e-8, law.cutoff = 2e-7;
    return law;
}

void checkDerivatives(const ContactLaw& law) {
    for (int n = 1; n < 100; ++n) {
        const double g = n / 100.0 * law.reach(), h = 1e-5 * g;
        const ContactLaw::Value up = law.at(g + h), down = law.at(g - h), here = law.at(g);
        EXPECT_NEAR((up.energy - down.energy) / (2 * h), here.slope, 1e-7 * (std::abs(here.slope) + 1)) << g;
        const double scale = std::abs(here.curvature) + std::abs(here.slope) / g;
        EXPECT_NEAR((up.slope - down.slope) / (2 * h), here.curvature, 1e-4 * scale) << g;
    }
}

void checkSmoothAt(const ContactLaw& law, double g) {
    const double e = 1e-7 * g;
    const ContactLaw::Value below = law.at(g - e), above = law.at(g + e), scale = law.at(0.5 * g);
    EXPECT_NEAR(below.energy, above.energy, 1e-5 * std::abs(scale.energy));
    EXPECT_NEAR(below.slope, above.slope, 1e-5 * std::abs(scale.slope));
    EXPECT_NEAR(below.curvature, above.curvature, 1e-5 * std::abs(scale.curvature));
}

TEST(Barrier, derivativesAndLimits) {
    const Barrier law = barrier();
    checkDerivatives(law);
    checkSmoothAt(law, law.length);
    EXPECT_EQ(law.at(law.length).energy, 0);
    EXPECT_EQ(law.at(2 * law.length).curvature, 0);
    EXPECT_EQ(law.range(), 1e-7);
    EXPECT_TRUE(std::isinf(law.at(0).energy));
    EXPECT_TRUE(std::isinf(law.at(-1e-9).energy));
    double before = law.at(1e-12 * law.length).energy;
    EXPECT_GT(before, 20 * law.strength);
    for (double s = 0.01; s < 1; s += 0.01) {
        const ContactLaw::Value now = law.at(s * law.length);
        EXPECT_LT(now.energy, before);
        EXPECT_LT(now.slope, 0);
        EXPECT_GT(now.curvature, 0);
        before = now.energy;
    }
    EXPECT_NEAR(-law.at(0.53 * law.length).slope, law.strength / law.length, 0.02 * law.strength / law.length);
    EXPECT_FALSE(law.restGap());
}

TEST(BarrierMorse, derivativesAndMinimum) {
    const BarrierMorse law = attraction();
    checkDerivatives(law);
    for (const double g : {law.length, law.rest, law.cutoff}) checkSmoothAt(law, g);
    ASSERT_TRUE(law.restGap());
    const ContactLaw::Value least = law.at(*law.restGap());
    EXPECT_NEAR(least.energy, -law.depth, 1e-12 * law.depth);
    EXPECT_NEAR(least.slope, 0, 1e-9 * law.depth / law.decay);
    EXPECT_NEAR(least.curvature, 2 * law.depth / (law.decay * law.decay), 1e-9 * least.curvature);
    for (double s = 0.01; s < 1; s += 0.01) EXPECT_GE(law.at(s * law.cutoff).energy, least.energy);
    EXPECT_TRUE(std::isinf(law.at(0).energy));
}

std::string problemsOf(const std::string& text) {
    struct Holder {
        Choice<ContactLaw> contact;
        static const Schema<Holder>& schema() {
            static const Schema<Holder> s =
                Schema<Holder>("holder", "a law").model("contact", &Holder::contact, "law of contact");
            return s;
        }
    };
    Problems problems;
    const auto read = corpuscle::read<Holder>(parseDictionary(text, "test.yaml", problems), problems);
    try {
        problems.throwIfAny();
    } catch (const CaseError& error) {
        return error.what();
    }
    return read.contact->reach() > 0 ? "" : "no reach";
}

TEST(ContactLaws, settings) {
    EXPECT_EQ(support::missing<ContactLaw>({"barrier", "barrierMorse"}), std::vector<std::string>{});
    EXPECT_EQ(problemsOf("contact: {type: barrier, reach: 80 nm, strength: 2e-6 N/m}\n"), "");
    EXPECT_NE(problemsOf("contact: {type: barrier, reach: 0 m, strength: 2e-6 N/m}\n"), "");
    const std::string morse =
        "contact: {type: barrierMorse, reach: 40 nm, strength: 2e-6 N/m, thickness: 20 nm, "
        "depth: 1e-7 N/m, decay: 30 nm, ";
    EXPECT_EQ(problemsOf(morse + "rest: 60 nm, cutoff: 200 nm}\n"), "");
    EXPECT_NE(problemsOf(morse + "rest: 30 nm, cutoff: 200 nm}\n").find("rest is below reach"), std::string::npos);
    EXPECT_NE(problemsOf(morse + "rest: 60 nm, cutoff: 50 nm}\n").find("cutoff above rest"), std::string::npos);
}

}  // namespace
}  // namespace corpuscle::contact
