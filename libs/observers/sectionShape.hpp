// Shape of a closed surface in the shear plane, and how its material has turned there.
//
// The shear plane is (x, g), g the direction across the walls: z, or y. The flow u = gammadot g e_x turns g towards x.
// Angles of orientation go from x towards g (the way in which inclinations are quoted), angles of rotation with the
// flow (from x towards -g), both in radians.
//
// quantity    | definition
// axis        | main axis: longer semi-axis of the ellipse in which the shear plane cuts the ellipsoid that has the
//             | second moments M = int x x^T dV of the enclosed volume; with B = (M^-1) restricted to the plane, the
//             | semi-axes are proportional to 1/sqrt(eigenvalue)
// D12_inertia | (l1 - l2)/(l1 + l2) of those semi-axes
// length L    | extent along the main axis of the surface's cross-section with the shear plane through the centroid
// height H    | the same at right angles to the main axis
// D12_extent  | |L - H|/(L + H)
// width       | extent of the whole surface along the vorticity axis
//
// The axis of greatest width would jump when the section is nearly round; the main axis of inertia turns fast there,
// but continuously.
//
// Undeformed Kuchel-Fackerell cell (d, h, b = 8, 2.12, 1 um), axis in the shear plane: D12_extent = (d - h)/(d + h) =
// 0.581028 (closed form), D12_inertia = 0.567483 (quadrature of the quartic's moments); the values a rigid cell keeps
// while it tumbles. Lac, Barthes-Biesel, Pelekasis, Tsamopoulos, J. Fluid Mech. 516:303 (2004) measure capsules by the
// ellipsoid of inertia.
#pragma once
#include <span>

#include "geometry/triangleMesh.hpp"

namespace corpuscle::observers {

struct ShearPlane {
    int gradient = 2;  // axis across the walls: 1 or 2
    int vorticity() const { return 3 - gradient; }
    Eigen::Vector2d in(const Vec3& x) const { return {x[0], x[gradient]}; }
};

struct SectionShape {
    double D12_extent, D12_inertia;
    double inclination;            // of the main axis against x, in (-pi/2, pi/2]
    double length, height, width;  // m
    Vec3 centroid;                 // m
};
// NaN throughout for a mesh without triangles; length, height and D12_extent are NaN where the plane through the
// centroid cuts none, as between two pieces of a broken cell.
SectionShape sectionShape(const geometry::TriangleMesh& mesh, const ShearPlane& plane);

// Best-fit rotation of points about the vorticity axis from `rest` to `now`, each about its mean point, in the sense of
// the flow, in (-pi, pi]: the angle that makes sum |R(angle) r - q|^2 least (Kabsch, Acta Cryst. A32:922, 1976, in the
// plane). It follows the material, so that it also works where the shape has no axis.
double materialRotation(std::span<const Vec3> rest, std::span<const Vec3> now, const ShearPlane& plane);

// Angle of a point about a centre, in the sense of the flow.
double flowAngle(const Vec3& fromCentre, const ShearPlane& plane);

// The angle that equals `angle` up to whole periods and is nearest to `last`.
double followed(double last, double angle, double period);

}  // namespace corpuscle::observers
