// Observers of vessels, on scenes whose numbers are known: a linear flow through a disc, a sphere between two planes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/spheroid.hpp"
#include "observers/sampleScene.hpp"

namespace corpuscle::observers::testing {
namespace {

const geometry::TriangleMesh& sphere() {
    static const geometry::TriangleMesh mesh = geometry::meshSurface(geometry::Sphere(3 * um), 0.8 * um);
    return mesh;
}

void moveCell(Scene& scene, const Vec3& by) {
    for (coupling::Cell& cell : scene.cells)
        for (Vec3& x : cell.membrane.position) x += by;
}

// u = gammadot z, through a disc of 2.6 um about z = 3 um: the sum over the lattice planes whose particles it holds. A
// slab of 6 spacings averages a lattice exactly.
TEST(Section, LinearFlow) {
    const Scene scene = sampleScene({.walls = true});
    const auto of = [&](const std::string& more) {
        const auto observation =
            begin("{type: section, every: 1 s, centre: [1 um, 0.5 um, 3 um], radius: 2.6 um, width: 6 um" + more + "}",
                  scene);
        return std::pair(value(*observation, observation->observe(scene, {}), "flowRate_m3_s"),
                         value(*observation, observation->observe(scene, {}), "meanVelocity_m_s"));
    };
    double flow = 0, area = 0;
    for (double y = -5.5; y < 6; ++y)
        for (double z = -5.5; z < 6; ++z)
            if (std::hypot(y - 0.5, z - 3) < 2.6) flow += 1000 * z * um * dx * dx, area += dx * dx;
    EXPECT_GT(area, 15 * dx * dx);
    EXPECT_NEAR(of("").first, flow, 1e-12 * flow);
    EXPECT_NEAR(of("").second, flow / area, 1e-12 * flow / area);
    EXPECT_NEAR(of(", normal: [-2, 0, 0]").first, -flow, 1e-12 * flow);
    EXPECT_NEAR(of(", normal: [0, 1, 0]").first, 0, 1e-12 * flow);
}

TEST(Section, CountsWhatIsWithinCells) {
    Scene scene = sampleScene({.walls = true, .cells = {{"a", Vec3(-5.5, 0, 0) * um}}, .surface = &sphere()});
    particles::ParticleStore& s = scene.store();
    for (std::size_t i = 0; i < s.size(); ++i) s.side[i] = s.z[i] > 2 * um ? 1 : 0;
    const auto disc = [&](const std::string& radius, const std::string& more = "") {
        return begin(
            "{type: section, every: 1 s, centre: [0 um, 0 um, 3 um], width: 4 um, radius: " + radius + more + "}",
            scene);
    };
    const auto observation = disc("1.8 um");
    const auto rows = observation->observe(scene, {});
    double inside = 0, all = 0, flowInside = 0, flow = 0;
    for (double y = -5.5; y < 6; ++y)
        for (double z = -5.5; z < 6; ++z)
            if (std::hypot(y, z - 3) < 1.8) ++all, flow += z, inside += z > 2, flowInside += z > 2 ? z : 0;
    EXPECT_NEAR(value(*observation, rows, "haematocrit_tube"), inside / all, 1e-12);
    EXPECT_NEAR(value(*observation, rows, "haematocrit_discharge"), flowInside / flow, 1e-12);
    EXPECT_EQ(value(*observation, rows, "cells"), 0);

    // Its middle is at z = 0, 3 um from the axis of this disc, but within a wider one.
    const auto wide = disc("4 um"), back = disc("4 um", ", normal: [-1, 0, 0]");
    const auto seen = [&](const auto& one) { return value(*one, one->observe(scene, {}), "cells"); };
    EXPECT_EQ(seen(wide), 0);
    EXPECT_EQ(seen(back), 0);
    moveCell(scene, Vec3(6, 0, 0) * um);
    EXPECT_EQ(seen(observation), 0);
    EXPECT_EQ(seen(wide), 1);
    EXPECT_EQ(seen(back), -1);
    EXPECT_EQ(seen(wide), 1) << "once";
    // On to the next image of the disc, half a box at a time, and across it after a restart.
    moveCell(scene, Vec3(6, 0, 0) * um);
    EXPECT_EQ(seen(wide), 1);
    moveCell(scene, Vec3(6, 0, 0) * um);
    EXPECT_EQ(seen(wide), 1) << "across the far side of the box";
    const auto again = disc("4 um");
    again->restore(wide->state());
    moveCell(scene, Vec3(4, 0, 0) * um);
    EXPECT_EQ(seen(again), 2);
    moveCell(scene, Vec3(-4, 0, 0) * um);
    EXPECT_EQ(seen(again), 1) << "backwards";
    // Through the disc and on, away from its axis, before the next output: at 3.2 um there, at 5 um in the end.
    moveCell(scene, Vec3(4.5, 0, 8) * um);
    EXPECT_EQ(seen(again), 2);
    moveCell(scene, Vec3(-2, 0, 0) * um);
    EXPECT_EQ(seen(again), 2) << "beside the disc";
}

// A sphere of 3 um at z = 1 um between planes at z = +-6 um: 2 um from the upper one and 4 um from the lower one.
TEST(CellFreeLayer, SphereBetweenPlanes) {
    const geometry::TriangleMesh fineSphere = geometry::meshSurface(geometry::Sphere(3 * um), 0.3 * um);
    const Scene scene = sampleScene({.walls = true, .cells = {{"a", Vec3(0, 0, 1) * um}}, .surface = &fineSphere});
    const auto whole = begin("{type: cellFreeLayer, every: 1 s, slices: 1, sectors: 1}", scene);
    const auto rows = whole->observe(scene, {});
    const double error = 0.02 * um;  // the nodes nearest to the planes lie beside the poles
    EXPECT_NEAR(value(*whole, rows, "thickness_m"), 3 * um, error);
    EXPECT_NEAR(value(*whole, rows, "deviation_m"), 1 * um, error);
    EXPECT_NEAR(value(*whole, rows, "least_m"), 2 * um, error);
    EXPECT_EQ(value(*whole, rows, "covered"), 1);
    EXPECT_EQ(rows.size(), 2u);
    EXPECT_NEAR(value(*whole, rows, "thickness_m", 1), 3 * um, error);

    // In 16 slices of 1 um, the sphere is in six. A slice from x to x + 1 um comes as near to the upper plane as its
    // side that is nearest to the middle.
    const auto fine = begin("{type: cellFreeLayer, every: 1 s, slices: 16, sectors: 1}", scene);
    const auto slices = fine->observe(scene, {});
    ASSERT_EQ(slices.size(), 17u);
    EXPECT_NEAR(value(*fine, slices, "covered"), 12.0 / 32, 1e-12);
    for (int k = 0; k < 16; ++k) {
        const double x = -7.5 + k, thickness = slices[static_cast<std::size_t>(k) + 1].values[1];
        EXPECT_NEAR(slices[static_cast<std::size_t>(k) + 1].values[0], x * um, 1e-18);
        if (std::abs(x) > 3) {
            EXPECT_TRUE(std::isnan(thickness)) << x;
            continue;
        }
        const double half = std::sqrt(9 - std::pow(std::abs(x) - 0.5, 2));
        EXPECT_NEAR(thickness, (5 - half + 7 - half) / 2 * um, 0.25 * um) << x;
        EXPECT_GE(thickness, (5 - half + 7 - half) / 2 * um - 1e-3 * um) << x;
    }
    // In strips along y that do not hold it there is no core.
    const auto strips = begin("{type: cellFreeLayer, every: 1 s, slices: 1, sectors: 12}", scene);
    EXPECT_NEAR(value(*strips, strips->observe(scene, {}), "covered"), 12.0 / 24, 1e-12);

    const Scene empty = sampleScene({.walls = true});
    const auto none = begin("{type: cellFreeLayer, every: 1 s}", empty);
    EXPECT_TRUE(std::isnan(value(*none, none->observe(empty, {}), "thickness_m")));
    EXPECT_EQ(value(*none, none->observe(empty, {}), "covered"), 0);
}

}  // namespace
}  // namespace corpuscle::observers::testing
