#include <gtest/gtest.h>

#include "observers/sampleScene.hpp"

namespace corpuscle::observers::testing {
namespace {

TEST(ModelName, observes) {
    const Scene scene = sampleScene({.size = Vec3(8, 8, 8) * um, .walls = true, .shearRate = 1000});
    const auto observer = choose<Observer>("{type: modelName, every: 0.1 strain}");
    const auto observation = observer->begin(scene);
    ASSERT_EQ(observation->tables().size(), 1u);
    const std::vector<Row> rows = observation->observe(scene, {});
    ASSERT_EQ(rows.size(), 1u);
    ASSERT_EQ(rows[0].values.size(), observation->tables()[0].columns.size());
    // The fluid is sheared, u = 1000 1/s z; its outermost layer is half a spacing away from the wall.
    EXPECT_NEAR(rows[0].values[0], 1000 * 3.5 * um, 1e-9);
}

}  // namespace
}  // namespace corpuscle::observers::testing
