// Mass and inertia of a homogeneous solid within a closed mesh: exact integrals over the polyhedron
// (geometry/triangleMesh.hpp), not sums over particles.
//
// The body frame has its origin at the centre of mass and its axes along the principal axes of inertia, in ascending
// order of the moments.
#pragma once
#include <Eigen/Geometry>

#include "geometry/triangleMesh.hpp"

namespace corpuscle::bodies {

struct Solid {
    double volume = 0;               // [m^3]
    double mass = 0;                 // [kg]
    Vec3 inertia = Vec3::Zero();     // principal moments [kg m^2]
    geometry::TriangleMesh surface;  // in the body frame

    // mesh: closed and outward oriented, at the position of the body; density [kg/m^3].
    Solid(geometry::TriangleMesh mesh, double density);

    double radius() const { return radius_; }  // of the enclosing sphere about the centre of mass [m]
    // Position and orientation of the body in the mesh as given.
    const Vec3& startCentre() const { return startCentre_; }
    const Eigen::Quaterniond& startOrientation() const { return startOrientation_; }

  private:
    double radius_ = 0;
    Vec3 startCentre_;
    Eigen::Quaterniond startOrientation_;  // rotation from the body frame to space
};

}  // namespace corpuscle::bodies
