// The tracer of streamlines in flows whose lines are known.
#include "streamline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace corpuscle {
namespace {

using End = Streamline::End;

const Vec3 outside = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());

Vec3 rotation(const Vec3& x) { return {-3 * x[1], 3 * x[0], 0}; }

// Steps of constant length around a circle turn by an angle; the radius changes by an error of fourth order per turn.
double radiusErrorAfterATurn(double step) {
    const Streamline line = trace(rotation, Vec3(1, 0, 0.5), {step, 20});
    EXPECT_EQ(line.downstream, End::closed);
    EXPECT_FALSE(line.upstream);
    EXPECT_NEAR(line.length(), 2 * M_PI, step * step);
    EXPECT_NEAR((line.points.back() - line.points.front()).norm(), 0, step / 10);
    for (const Vec3& x : line.points) EXPECT_EQ(x[2], 0.5);
    return std::abs(line.points[line.points.size() - 2].head<2>().norm() - 1);
}

TEST(Streamline, ClosesAroundAVortexToFourthOrder) {
    const double ratio = radiusErrorAfterATurn(0.2) / radiusErrorAfterATurn(0.1);
    EXPECT_GT(ratio, 12);
    EXPECT_LT(ratio, 40);
}

// Outwards the spiral is followed to its greatest length, inwards to the centre, which is 1/sin(atan(0.1)) away.
TEST(Streamline, ASpiralDoesNotClose) {
    const auto spiral = [](double sign) {
        return trace([sign](const Vec3& x) -> Vec3 { return rotation(x) + sign * 0.3 * x; }, Vec3(1, 0, 0), {0.05, 12});
    };
    const Streamline outwards = spiral(1), inwards = spiral(-1);
    EXPECT_EQ(outwards.downstream, End::length);
    EXPECT_FALSE(outwards.upstream);
    EXPECT_NEAR(outwards.length(), 12, 0.06);
    EXPECT_EQ(inwards.downstream, End::still);
    EXPECT_NEAR(inwards.length(), 12 + 1 / std::sin(std::atan(0.1)), 0.5) << "and upstream";
}

// Along the hyperbolae around a stagnation point x z is constant; the fluid ends at |x| = 2 and |z| = 2.
TEST(Streamline, IsFollowedBothWaysToTheEndOfTheFluid) {
    const auto hyperbolic = [](const Vec3& x) -> Vec3 {
        return x.cwiseAbs().maxCoeff() < 2 ? Vec3(x[0], 0, -x[2]) : outside;
    };
    constexpr double step = 0.01;
    const Streamline line = trace(hyperbolic, Vec3(0.5, 0, 0.6), {step, 20});
    EXPECT_EQ(line.downstream, End::outside);
    EXPECT_EQ(line.upstream, End::outside);
    EXPECT_EQ(line.points[line.seed], Vec3(0.5, 0, 0.6));
    for (const Vec3& x : line.points) EXPECT_NEAR(x[0] * x[2], 0.3, 1e-8);
    EXPECT_NEAR(line.points.front()[2], 2, step / 8);
    EXPECT_NEAR(line.points.back()[0], 2, step / 8);
    EXPECT_LT(line.points.back()[0], 2);
}

TEST(Streamline, EndsAfterAPeriodOfTheFlow) {
    const auto oblique = [](const Vec3&) -> Vec3 { return {-2, 1, 0}; };
    const Streamline line = trace(oblique, Vec3(0.3, 0, 0), {0.07, 100, Vec3(4, 3, 0)});
    EXPECT_EQ(line.downstream, End::period);
    EXPECT_NEAR((line.points.back() - Vec3(-3.7, 2, 0)).norm(), 0, 1e-12);
    EXPECT_EQ(line.points.front(), Vec3(0.3, 0, 0));
}

TEST(Streamline, EndsWhereTheFluidIsStill) {
    const auto sink = [](const Vec3& x) -> Vec3 { return -x; };
    const Streamline line = trace(sink, Vec3(1, 0, 0), {0.03, 5});
    EXPECT_EQ(line.downstream, End::still);
    EXPECT_NEAR(line.points.back().norm(), 0, 0.03);
    EXPECT_EQ(line.upstream, End::length);
    EXPECT_NEAR(line.points.front()[0], 6, 0.06);
}

}  // namespace
}  // namespace corpuscle
