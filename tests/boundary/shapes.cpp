// Walls of closed form, against other methods: distances against the nearest of many points of the surface, which are
// made from its parametric form; volumes by counting points; flow rates against published and own values.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "boundary/wallShape.hpp"
#include "core/settings.hpp"

namespace corpuscle::boundary {
namespace {

constexpr double pi = std::numbers::pi;

std::shared_ptr<const WallShape> shapeOf(const std::string& text) {
    Problems problems;
    auto shape = readChoice<WallShape>(parseValue(text, "constant/flow.yaml", problems), problems);
    problems.throwIfAny();
    return shape.model;
}

const particles::Box box{Vec3(-3, -2, -2), Vec3(3, 2, 2), {true, false, false}};

struct Form {
    std::string text;
    // Point of the cross-section's edge at the angle a and the place x along the tube.
    std::function<Vec3(double x, double a)> point;
    double area, volume;  // 0: not known in closed form
};

Vec3 round(double x, double radius, double a) { return {x, radius * std::cos(a), radius * std::sin(a)}; }

double throat(double x) {  // {diameter: 3.6, throat: 2, length: 1, taper: 1.5}
    const double u = std::clamp((std::abs(x) - 0.5) / 1.5, 0.0, 1.0);
    return 1.4 - 0.4 * std::cos(pi * u);
}

const std::vector<Form> forms{
    {"{type: tube, diameter: 3 m}", [](double x, double a) { return round(x, 1.5, a); }, 2 * pi * 1.5 * 6,
     pi * 2.25 * 6},
    {"{type: duct, width: 3 m, height: 2 m}",
     [](double x, double a) {
         const double p = 10 * a / (2 * pi);
         if (p < 3) return Vec3(x, p - 1.5, -1);
         if (p < 5) return Vec3(x, 1.5, p - 4);
         if (p < 8) return Vec3(x, 6.5 - p, 1);
         return Vec3(x, -1.5, 9 - p);
     },
     60, 36},
    {"{type: ellipticTube, width: 3.6 m, height: 1.6 m}",
     [](double x, double a) { return Vec3(x, 1.8 * std::cos(a), 0.8 * std::sin(a)); }, 0, pi * 1.8 * 0.8 * 6},
    {"{type: ellipticTube, width: 1.6 m, height: 3.6 m}",
     [](double x, double a) { return Vec3(x, 0.8 * std::cos(a), 1.8 * std::sin(a)); }, 0, pi * 1.8 * 0.8 * 6},
    {"{type: sinusoidalTube, diameter: 2.4 m, amplitude: 0.4, waves: 2}",
     [](double x, double a) { return round(x, 1.2 * (1 + 0.4 * std::cos(2 * pi * x / 3)), a); }, 0,
     pi * 1.44 * (1 + 0.08) * 6},
    {"{type: constriction, diameter: 3.6 m, throat: 2 m, length: 1 m, taper: 1.5 m}",
     [](double x, double a) { return round(x, throat(x), a); }, 0, 0},
};

class Shapes : public testing::TestWithParam<Form> {};

TEST_P(Shapes, distanceAndNormal) {
    const Form& form = GetParam();
    const Walls walls = shapeOf(form.text)->place(box);
    ASSERT_EQ(walls.count(), 1u);
    const Wall& wall = walls[0];
    std::vector<Vec3> surface;  // in three boxes
    const int along = 1200, around = 400;
    for (int i = 0; i < along; ++i)
        for (int j = 0; j < around; ++j)
            surface.push_back(form.point(-9 + 18 * (i + 0.5) / along, 2 * pi * (j + 0.5) / around));
    std::mt19937 random(1);
    std::uniform_real_distribution<double> x(-3, 3), across(-2.2, 2.2);
    std::vector<double> one[3];
    std::vector<double> expected;
    for (int k = 0; k < 60; ++k) {
        const Vec3 p(x(random), across(random), across(random));
        double least = 1e9;
        for (const Vec3& s : surface) least = std::min(least, (s - p).norm());
        const double found = wall.distance(p);
        // The nearest of the points is at most half the distances between them away from the nearest of the surface; at
        // an edge, where there is no point, it is as much further away.
        const double beside = form.text.find("duct") != std::string::npos ? 0.0126 : 1e-4;
        EXPECT_LE(std::abs(found), least + 1e-12) << p.transpose();
        EXPECT_GE(std::hypot(found, 0.016) + beside, least) << p.transpose();
        EXPECT_NEAR(wall.distance(p + Vec3(6, 0, 0)), found, 1e-12) << "the period of the box";
        // Along the normal the distance grows as fast as the way.
        if (std::abs(found) > 0.05 && std::abs(found) < 0.4) {
            EXPECT_NEAR(wall.distance(p + 1e-4 * wall.normal(p)) - found, 1e-4, 2e-7) << p.transpose();
        }
        for (int c = 0; c < 3; ++c) one[c].push_back(p[c]);
        expected.push_back(found);
    }
    std::vector<double> least;
    walls.findDistances({{one[0].data(), one[1].data(), one[2].data()}, expected.size()}, least);
    for (std::size_t k = 0; k < least.size(); ++k) EXPECT_NEAR(least[k], expected[k], 1e-14);
    const Vec3 onIt = form.point(0.7, 0.9);
    EXPECT_NEAR(wall.distance(onIt), 0, 1e-12);
    EXPECT_GT(wall.distance(Vec3(0.7, 0, 0)), 0) << "fluid on the axis";
}

TEST_P(Shapes, areaAndVolumes) {
    const Form& form = GetParam();
    const auto shape = shapeOf(form.text);
    const Wall wall = shape->place(box)[0];
    if (form.volume > 0) {
        EXPECT_NEAR(shape->volume(box), form.volume, 1e-6 * form.volume);
    }
    if (form.area > 0) {
        EXPECT_NEAR(wall.surface->area(), form.area, 1e-12 * form.area);
    }
    // By counting: the fluid, and layers of this depth behind the walls and in front of them, twice the area deep.
    const double h = 0.04, depth = 0.3;
    double fluid = 0, behind = 0, near = 0;
    for (double x = -3 + h / 2; x < 3; x += h)
        for (double y = -2.4 + h / 2; y < 2.4; y += h)
            for (double z = -2.4 + h / 2; z < 2.4; z += h) {
                const double d = wall.distance(Vec3(x, y, z));
                fluid += d > 0, behind += d <= 0 && d > -depth, near += std::abs(d) < 0.1;
            }
    const double cube = h * h * h;
    EXPECT_NEAR(fluid * cube, shape->volume(box), 5e-3 * shape->volume(box));
    EXPECT_NEAR(behind * cube, shape->volumeBehind(box, Vec3::Constant(depth)), 0.03 * behind * cube);
    EXPECT_NEAR(near * cube / 0.2, wall.surface->area(), 0.02 * wall.surface->area());
}

TEST_P(Shapes, doNotEndTheFluidAlongTheFlow) {
    const auto shape = shapeOf(GetParam().text);
    EXPECT_FALSE(shape->isAcross(0));
    EXPECT_TRUE(shape->isAcross(1) && shape->isAcross(2));
    EXPECT_FALSE(shape->planesAcross().has_value());
    Problems problems;
    shape->check(box, {}, problems);
    EXPECT_TRUE(problems.empty());
    shape->check({Vec3(-3, -0.7, -0.7), Vec3(3, 0.7, 0.7), {true, false, false}}, {}, problems);
    EXPECT_FALSE(problems.empty()) << "wider than the box";
}

INSTANTIATE_TEST_SUITE_P(All, Shapes, testing::ValuesIn(forms));

// Own solutions of the exact series to 6 digits (grade A), Q = k G h^4/mu and u = k G h^2/mu; the triangle's and the
// ellipse's are closed forms.
TEST(Hydraulics, ducts) {
    const Hydraulics square = shapeOf("{type: duct, width: 2 m, height: 2 m}")->hydraulics(box);
    EXPECT_NEAR(*square.conductance, 0.0351443 * 16, 1e-6 * 16);
    EXPECT_NEAR(square.fastest, 0.0736714 * 4, 1e-6 * 4);
    for (const char* text : {"{type: duct, width: 3 m, height: 1.5 m}", "{type: duct, width: 1.5 m, height: 3 m}"}) {
        const Hydraulics twice = shapeOf(text)->hydraulics(box);
        EXPECT_NEAR(*twice.conductance, 0.1143408 * std::pow(1.5, 4), 1e-6 * 5.1);
        EXPECT_NEAR(twice.fastest, 0.1138718 * 2.25, 1e-6 * 2.25);
    }
    const Hydraulics wide = shapeOf("{type: duct, width: 2000 m, height: 1 m}")->hydraulics(box);
    EXPECT_NEAR(wide.fastest, 1.0 / 8, 1e-4) << "planes";
    EXPECT_NEAR(*wide.conductance, 2000.0 / 12, 0.1) << "planes";
}

TEST(Hydraulics, tubes) {
    const Hydraulics tube = shapeOf("{type: tube, diameter: 3 m}")->hydraulics(box);
    EXPECT_NEAR(*tube.conductance, pi * std::pow(1.5, 4) / 8, 1e-12);
    EXPECT_NEAR(tube.fastest, 1.5 * 1.5 / 4, 1e-12);
    const Hydraulics ellipse = shapeOf("{type: ellipticTube, width: 3 m, height: 3 m}")->hydraulics(box);
    EXPECT_NEAR(*ellipse.conductance, *tube.conductance, 1e-12);
    EXPECT_NEAR(ellipse.fastest, tube.fastest, 1e-12);
    // The mean of (R/R0)^-4 for an amplitude of 0.3 is 1.57889.
    const Hydraulics waves = shapeOf("{type: sinusoidalTube, diameter: 2 m, amplitude: 0.3}")->hydraulics(box);
    EXPECT_NEAR(waves.fastest, 2 * (pi / 8 / 1.57889) / (pi * 0.49), 1e-5);
    EXPECT_NEAR(waves.width, 0.7, 1e-6);
}

TEST(Hydraulics, planes) {
    const Hydraulics planes = shapeOf("{type: planes}")->hydraulics(box);
    EXPECT_DOUBLE_EQ(planes.fastest, 2.0);
    EXPECT_NEAR(*planes.conductance, 64.0 / 12 * 4, 1e-12);
    EXPECT_DOUBLE_EQ(planes.width, 4);
}

TEST(Constriction, refusesAThroatAsWideAsTheTube) {
    Problems problems;
    shapeOf("{type: constriction, diameter: 2 m, throat: 3 m, taper: 1 m}")->check(box, {}, problems);
    EXPECT_FALSE(problems.empty());
    Problems longer;
    shapeOf("{type: constriction, diameter: 2 m, throat: 1 m, length: 3 m, taper: 2 m}")->check(box, {}, longer);
    EXPECT_FALSE(longer.empty()) << "longer than the box";
}

}  // namespace
}  // namespace corpuscle::boundary
