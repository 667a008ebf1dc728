#include "boundary/modelNameWalls.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "sph/flow.hpp"

namespace corpuscle::boundary {
namespace {

constexpr double pi = std::numbers::pi;

// Fluid can flow between these walls when a case names them.
TEST(ModelNameWalls, boundAFlow) {
    Problems problems;
    const std::string text = "{type: poiseuille, bodyForce: 1 m/s^2, walls: {type: modelName, radius: 2 m}}";
    const auto flow = readChoice<sph::Flow>(parseValue(text, "constant/flow.yaml", problems), problems);
    problems.throwIfAny();
    ASSERT_TRUE(flow->walls());
    EXPECT_FALSE(flow->walls()->isAcross(0));
    EXPECT_TRUE(flow->walls()->isAcross(1) && flow->walls()->isAcross(2));
    sph::FlowContext context;
    context.box = {Vec3(-3, -2, -2), Vec3(3, 2, 2), {true, false, false}};
    context.density = 1000, context.viscosity = context.leastViscosity = 1000;
    const sph::FlowState state = flow->resolve(context, {}, problems);
    problems.throwIfAny();
    EXPECT_NEAR(state.speed, 1.0, 1e-12) << "F R^2/(4 nu)";
    ASSERT_EQ(state.walls.count(), 1u);
    const Wall& wall = state.walls[0];
    EXPECT_DOUBLE_EQ(wall.distance(Vec3(5, 1.2, 0.9)), 0.5);
    EXPECT_DOUBLE_EQ(wall.distance(Vec3(5, 0, -3)), -1);
    EXPECT_TRUE(wall.normal(Vec3(5, 0, -3)).isApprox(Vec3(0, 0, 1)));
    EXPECT_DOUBLE_EQ(wall.surface->area(), 2 * pi * 2 * 6);
    EXPECT_DOUBLE_EQ(flow->walls()->volume(context.box), pi * 4 * 6);
    EXPECT_DOUBLE_EQ(flow->walls()->volumeBehind(context.box, Vec3(1, 1, 1)), pi * 5 * 6);
}

}  // namespace
}  // namespace corpuscle::boundary
