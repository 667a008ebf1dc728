#include "sph/modelNameFlow.hpp"

#include <gtest/gtest.h>

namespace corpuscle::sph {
namespace {

TEST(ModelNameFlow, resolves) {
    Problems problems;
    const auto flow =
        readChoice<Flow>(parseValue("{type: modelName, speed: 2 m/s}", "constant/flow.yaml", problems), problems);
    problems.throwIfAny();
    FlowContext context;
    context.box = {Vec3(-1, -1, -1), Vec3(3, 1, 1), {true, true, true}};
    context.density = 1000, context.viscosity = 1e-3;
    const FlowState state = flow->resolve(context, {}, problems);
    problems.throwIfAny();
    EXPECT_EQ(state.density, 1000);
    EXPECT_EQ(state.rate, 0.5);
    EXPECT_EQ(state.velocity(Vec3(0.3, 0.2, 0.1)), Vec3(2, 0, 0));
    EXPECT_FALSE(state.walls.exist());
}

}  // namespace
}  // namespace corpuscle::sph
