#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "geometry/evansFung.hpp"
#include "geometry/fileShape.hpp"
#include "geometry/kuchelFackerell.hpp"
#include "geometry/spheroid.hpp"
#include "support/registered.hpp"

using namespace corpuscle;
using namespace corpuscle::geometry;

namespace {

const KuchelFackerell redCell(8e-6, 2.12e-6, 1e-6);

std::string failureOf(const Shape& shape) {
    try {
        shape.prepare(".");
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::invalidCase);
        return failure.what();
    }
    return "";
}

// Reference numbers below: derived anew from the three conditions d, h, b, with 30-digit arithmetic (grade: analytic).
TEST(KuchelFackerell, quarticCoefficients) {
    const auto [P, Q, R] = redCell.quartic();
    EXPECT_NEAR(P * 1e12, -15.2603529814, 1e-9);
    EXPECT_NEAR(Q * 1e12, 47.0874091910, 1e-9);
    EXPECT_NEAR(R * 1e24, -11.8343522978, 1e-9);
}

TEST(KuchelFackerell, discCyclideConstants) {
    const auto cyclide = redCell.discCyclide();
    EXPECT_NEAR(cyclide.A * 1e6, 3.43093408314, 1e-10);
    EXPECT_NEAR(cyclide.m, 0.921313132191, 1e-11);
    EXPECT_NEAR(cyclide.nu1, 0.541917879699, 1e-11);
    EXPECT_NEAR(cyclide.K, 2.69140844076, 1e-10);
}

TEST(KuchelFackerell, discCyclideLiesOnTheQuartic) {
    const auto cyclide = redCell.discCyclide();
    double worst = 0, thickest = 0;
    for (int i = -60; i <= 60; ++i)
        for (int j = 0; j < 7; ++j) {
            const Vec3 x = cyclide.at(i / 60.0 * cyclide.K, 0.9 * j);
            worst = std::max(worst, std::abs(redCell.implicit(x)) / std::pow(redCell.d, 4));
            thickest = std::max(thickest, 2 * x.z());
        }
    EXPECT_LT(worst, 1e-13);
    EXPECT_NEAR(thickest, 2.12e-6, 2e-9);
    EXPECT_NEAR(cyclide.at(0, 0).x(), 4e-6, 1e-18);
    EXPECT_NEAR(cyclide.at(cyclide.K, 0).z(), 0.5e-6, 1e-15);
}

// Points (rho, z) in um of the profile from the disc-cyclide form in 30-digit arithmetic.
TEST(KuchelFackerell, profileOfTheReference) {
    for (const auto& [rho, z] :
         {std::pair{3.99759371913, 0.0637994655319}, {3.99039200468, 0.127291425622}, {3.97844591903, 0.190172515315}})
        EXPECT_LT(std::abs(redCell.implicit({rho * 1e-6, 0, z * 1e-6})), 1e-12 * std::pow(8e-6, 4));
}

TEST(KuchelFackerell, areaAndVolume) {
    EXPECT_NEAR(redCell.area() * 1e12, 128.030428436, 2e-7);  // the two reference quadratures differ by 1e-7
    EXPECT_NEAR(redCell.volume() * 1e18, 85.9883260605, 1e-9);
}

TEST(KuchelFackerell, refusesImpossibleSizes) {
    EXPECT_EQ(failureOf(redCell), "");
    EXPECT_NE(failureOf(KuchelFackerell(8e-6, 1e-6, 2e-6)).find("b = 2 um"), std::string::npos);
    EXPECT_NE(failureOf(KuchelFackerell(-8e-6, 2e-6, 1e-6)).find("greater than 0"), std::string::npos);
    // The smallest diameter is sqrt(2 h^2 + 2 h sqrt(h^2 - b^2)) = 4.119 um here.
    const std::string small = failureOf(KuchelFackerell(4.1e-6, 2.12e-6, 1e-6));
    EXPECT_NE(small.find("greater than 4.11"), std::string::npos) << small;
    EXPECT_EQ(failureOf(KuchelFackerell(4.13e-6, 2.12e-6, 1e-6)), "");
}

// Evans and Fung 1972, coefficients at 300 mOsm; area and volume computed with 30 digits (published: 135, 94 within 11
// %).
TEST(EvansFung, areaVolumeAndThickness) {
    const EvansFung cell;
    EXPECT_NEAR(cell.area() * 1e12, 134.089686577, 3e-7);
    EXPECT_NEAR(cell.volume() * 1e18, 94.0910641006, 1e-9);
    EXPECT_NEAR(cell.box().max().z() * 2e6, 2.56567372122, 1e-4);
    EXPECT_EQ(failureOf(cell), "");
    EvansFung flat;
    flat.C4 = -9e-6;
    EXPECT_NE(failureOf(flat).find("thickness"), std::string::npos);
}

TEST(Spheroid, areaInClosedForm) {
    const double a = 3e-6, c = 0.9e-6, e = std::sqrt(1 - c * c / (a * a)), pi = std::numbers::pi;
    const Spheroid spheroid(a, c);
    EXPECT_NEAR(spheroid.area() / (2 * pi * a * a * (1 + (1 - e * e) / e * std::atanh(e))), 1, 1e-11);
    EXPECT_NEAR(spheroid.volume() / (4 * pi / 3 * a * a * c), 1, 1e-11);
}

TEST(Shape, gradientIsTheDerivative) {
    const EvansFung fung;
    const Spheroid spheroid(4e-6, 1e-6);
    const Sphere sphere(3e-6);
    for (const Shape* shape : {static_cast<const Shape*>(&redCell), static_cast<const Shape*>(&fung),
                               static_cast<const Shape*>(&spheroid), static_cast<const Shape*>(&sphere)}) {
        const Vec3 x(1.7e-6, -1.1e-6, 0.8e-6), g = shape->gradient(x);
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3 step = 1e-10 * Vec3::Unit(axis);
            const double slope = (shape->implicit(x + step) - shape->implicit(x - step)) / 2e-10;
            EXPECT_NEAR(slope, g[axis], 1e-6 * g.norm());
        }
    }
}

TEST(Shape, projectionLandsOnTheSurfaceToRounding) {
    const EvansFung fung;
    for (const Shape* shape : {static_cast<const Shape*>(&redCell), static_cast<const Shape*>(&fung)})
        for (int i = 0; i < 500; ++i) {
            const double angle = 0.37 * i, t = 1.5 * (i % 101) / 100.0;
            const auto p = static_cast<const AxisymmetricShape*>(shape)->profile(t);
            const double off = 0.15e-6 * std::sin(7.0 * i);
            const Vec3 x((p.rho + off) * std::cos(angle), (p.rho + off) * std::sin(angle), p.z + off);
            const Vec3 q = shape->project(x);
            EXPECT_LT(std::abs(shape->implicit(q)) / shape->gradient(q).norm(), 8e-15 * shape->radius());
            EXPECT_LT((q - x).norm(), 0.5e-6);
        }
}

TEST(Shape, chosenByNameInACase) {
    Problems problems;
    const Node node = parseDictionary("{type: kuchelFackerell, d: 8 um, h: 2.12 um, b: 1 um}", "mesh.yaml", problems);
    const auto choice = readChoice<Shape>(node, problems);
    ASSERT_TRUE(problems.empty());
    EXPECT_EQ(choice->radius(), 4e-6);
    EXPECT_EQ(corpuscle::support::missing<Shape>({"evansFung", "file", "kuchelFackerell", "sphere", "spheroid"}),
              std::vector<std::string>());
}

TEST(FileShape, readsStlMergedAndCentred) {
    const std::string path = testing::TempDir() + "corpuscleTetra.stl";
    std::ofstream(path)
        << "solid t\n"
           "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n"
           "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
           "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\nendloop\nendfacet\n"
           "facet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\n"
           "endsolid t\n";
    FileShape shape;
    shape.file = path;
    shape.prepare("/");
    EXPECT_EQ(shape.triangulation()->nodes.size(), 4u);
    EXPECT_NEAR(shape.volume(), 1e-18 / 6, 1e-30);
    EXPECT_LT(shape.triangulation()->centroid().norm(), 1e-20);
    EXPECT_LT(shape.implicit(Vec3::Zero()), 0);
    const Vec3 top(-0.25e-6, -0.25e-6, 0.75e-6);  // the node (0, 0, 1) as seen from the centroid
    EXPECT_NEAR(shape.implicit(top + Vec3(0, 0, 0.25e-6)), 0.25e-6, 1e-15);
    EXPECT_NEAR(shape.project(2 * top).z(), 0.75e-6, 1e-15);
}

TEST(FileShape, saysWhatIsWrongWithTheFile) {
    FileShape shape;
    shape.file = "nothing.stl";
    EXPECT_THROW(shape.prepare("/tmp"), Failure);
    const std::string path = testing::TempDir() + "corpuscleOpen.off";
    std::ofstream(path) << "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n";
    shape.file = path;
    try {
        shape.prepare("/");
        FAIL();
    } catch (const Failure& failure) {
        EXPECT_NE(std::string(failure.what()).find("3 open edges"), std::string::npos) << failure.what();
    }
}

}  // namespace
