// Shape and rotation of single surfaces, against closed forms.
#include "observers/sectionShape.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "geometry/kuchelFackerell.hpp"
#include "geometry/mesher.hpp"
#include "geometry/spheroid.hpp"

namespace corpuscle::observers {
namespace {

constexpr double um = 1e-6, pi = std::numbers::pi;

Mat3 withFlow(double angle, const ShearPlane& plane) {
    // About the vorticity axis, turning the gradient axis towards x.
    Mat3 r = Mat3::Identity();
    const int g = plane.gradient;
    r(0, 0) = r(g, g) = std::cos(angle);
    r(0, g) = std::sin(angle);
    r(g, 0) = -std::sin(angle);
    return r;
}

const geometry::TriangleMesh& redCell() {
    static const geometry::TriangleMesh mesh =
        geometry::meshSurface(geometry::KuchelFackerell(8 * um, 2.12 * um, 1 * um), 0.25 * um);
    return mesh;
}

geometry::TriangleMesh ellipsoid(const Vec3& semi) {
    geometry::TriangleMesh mesh = geometry::meshSurface(geometry::Sphere(1 * um), 0.15 * um);
    for (Vec3& x : mesh.nodes) x = x.cwiseProduct(semi);
    return mesh;
}

// D by extent is (d - h)/(d + h), by inertia a quadrature of the quartic (header of SectionShape). Chords shorten h by
// about edge^2 curvature/8 = 0.8 %, which is 0.002 in D.
TEST(SectionShape, UndeformedRedCell) {
    const SectionShape s = sectionShape(redCell(), {});
    EXPECT_NEAR(s.D12_extent, 0.581028, 0.002);
    EXPECT_NEAR(s.D12_inertia, 0.567483, 0.001);
    EXPECT_NEAR(s.length, 8 * um, 0.02 * um);
    EXPECT_NEAR(s.height, 2.12 * um, 0.02 * um);
    EXPECT_NEAR(s.width, 8 * um, 0.02 * um);
    EXPECT_NEAR(s.inclination, 0, 1e-3);
    EXPECT_LT(s.centroid.norm(), 0.01 * um);
}

TEST(SectionShape, TurnedAndMovedRedCellKeepsItsNumbers) {
    const SectionShape rest = sectionShape(redCell(), {});
    for (const double angle : {-0.3, 0.4, 1.2}) {
        geometry::TriangleMesh mesh = redCell();
        mesh.rotate(withFlow(angle, {}));
        mesh.translate({30 * um, -5 * um, 2 * um});
        const SectionShape s = sectionShape(mesh, {});
        EXPECT_NEAR(s.D12_extent, rest.D12_extent, 1e-9);
        EXPECT_NEAR(s.D12_inertia, rest.D12_inertia, 1e-9);
        EXPECT_NEAR(s.inclination, rest.inclination - angle, 1e-9);  // the flow decreases the inclination
        EXPECT_NEAR(s.centroid.x(), 30 * um, 0.01 * um);
    }
}

// Semi-axes 3, 1, 2 along x, y, z: D = 1/5 in x-z, 1/2 in x-y; the mesh is an affine image of that of a sphere.
TEST(SectionShape, EllipsoidInBothShearPlanes) {
    const geometry::TriangleMesh mesh = ellipsoid({3, 1, 2});
    const SectionShape z = sectionShape(mesh, {2}), y = sectionShape(mesh, {1});
    EXPECT_NEAR(z.D12_extent, 0.2, 0.004);
    EXPECT_NEAR(z.D12_inertia, 0.2, 0.001);
    EXPECT_NEAR(z.width, 2 * um, 0.01 * um);
    EXPECT_NEAR(y.D12_extent, 0.5, 0.004);
    EXPECT_NEAR(y.D12_inertia, 0.5, 0.001);
    EXPECT_NEAR(y.width, 4 * um, 0.02 * um);
    EXPECT_NEAR(z.length, 6 * um, 0.04 * um);
    EXPECT_NEAR(z.height, 4 * um, 0.04 * um);
}

// An ellipsoid that leans out of the shear plane: its cut with the plane has the matrix (M^-1) restricted, not M
// restricted.
TEST(SectionShape, LeaningEllipsoidIsCutNotProjected) {
    geometry::TriangleMesh mesh = ellipsoid({3, 1, 1});
    mesh.rotate(Eigen::AngleAxisd(0.7, Vec3::UnitZ()).toRotationMatrix());
    const double along = 1 / std::sqrt(std::pow(std::cos(0.7) / 3, 2) + std::pow(std::sin(0.7), 2));
    const double D = (along - 1) / (along + 1);
    const SectionShape s = sectionShape(mesh, {});
    EXPECT_NEAR(s.D12_inertia, D, 0.002);
    EXPECT_NEAR(s.D12_extent, D, 0.005);
}

TEST(SectionShape, NothingLeftIsNotANumber) { EXPECT_TRUE(std::isnan(sectionShape({}, {}).D12_extent)); }

// The plane through the centroid of two pieces on either side of it cuts neither of them.
TEST(SectionShape, SectionBetweenTwoPiecesIsNotANumber) {
    geometry::TriangleMesh mesh = ellipsoid({1, 1, 1}), other = mesh;
    mesh.translate({0, -2 * um, 0}), other.translate({0, 2 * um, 0});
    const int n = static_cast<int>(mesh.nodes.size());
    mesh.nodes.insert(mesh.nodes.end(), other.nodes.begin(), other.nodes.end());
    for (Index3 t : other.triangles) {
        for (auto& node : t) node += n;
        mesh.triangles.push_back(t);
    }
    const SectionShape s = sectionShape(mesh, {});
    for (const double extent : {s.length, s.height, s.D12_extent}) EXPECT_TRUE(std::isnan(extent)) << extent;
    EXPECT_NEAR(s.width, 6 * um, 0.02 * um);
    EXPECT_LT(s.centroid.norm(), 1e-3 * um);
}

TEST(MaterialRotation, FollowsTheFlowInBothPlanesEvenForASphere) {
    const geometry::TriangleMesh sphere = ellipsoid({1, 1, 1});
    for (const int g : {1, 2}) {
        const ShearPlane plane{g};
        geometry::TriangleMesh turned = sphere;
        turned.rotate(withFlow(2.5, plane));
        turned.translate({1 * um, 2 * um, 3 * um});
        EXPECT_NEAR(materialRotation(sphere.nodes, turned.nodes, plane), 2.5, 1e-12);
        // Simple shear moves g > 0 towards +x: the rotation is positive, for small strains half the strain.
        geometry::TriangleMesh sheared = sphere;
        for (Vec3& x : sheared.nodes) x[0] += 0.01 * x[g];
        EXPECT_NEAR(materialRotation(sphere.nodes, sheared.nodes, plane), 0.005, 1e-4);
    }
}

TEST(Followed, AngleGoesOnWithoutJumps) {
    double last = 0;
    for (int n = 1; n <= 100; ++n) last = followed(last, std::remainder(0.3 * n, 2 * pi), 2 * pi);
    EXPECT_NEAR(last, 30, 1e-10);
    for (int n = 99; n >= -50; --n) last = followed(last, std::remainder(0.3 * n, 2 * pi), 2 * pi);
    EXPECT_NEAR(last, -15, 1e-10);
}

}  // namespace
}  // namespace corpuscle::observers
