#include "membrane/modelName.hpp"

#include <gtest/gtest.h>

#include "core/registry.hpp"

namespace corpuscle::membrane {
namespace {

Choice<BondLaw> read(const std::string& text) {
    Problems problems;
    auto law = readChoice<BondLaw>(parseValue(text, "test", problems), problems);
    problems.throwIfAny();
    return law;
}

TEST(ModelName, isReadByItsName) {
    EXPECT_EQ(read("{type: modelName, k: 2 N/m}").name, "modelName");
    EXPECT_THROW(read("{type: modelName, k: -2 N/m}"), CaseError);
    EXPECT_THROW(read("modelName"), CaseError);
}

// Tension and stiffness are the derivatives of the energy.
TEST(ModelName, derivatives) {
    const auto law = read("{type: modelName, k: 2 N/m}");
    const auto& model = dynamic_cast<const ModelName&>(*law);
    const double l0 = 1.1, step = 1e-5;
    EXPECT_NEAR(model.tension(l0, l0), 0, 1e-12);  // no tension at the rest length
    for (const double l : {0.9, 1.1, 1.3}) {
        const double slope = (model.energy(l + step, l0) - model.energy(l - step, l0)) / (2 * step),
                     curvature = (model.derivative(l + step, l0) - model.derivative(l - step, l0)) / (2 * step);
        EXPECT_NEAR(model.tension(l, l0), slope, 1e-8) << l;
        EXPECT_NEAR(model.stiffness(l, l0), curvature, 1e-8) << l;
    }
}

}  // namespace
}  // namespace corpuscle::membrane
