#include "bodies/solid.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace corpuscle::bodies {

Solid::Solid(geometry::TriangleMesh mesh, double density)
    : volume(mesh.volume()), mass(density * volume), surface(std::move(mesh)), startCentre_(surface.centroid()) {
    const Eigen::SelfAdjointEigenSolver<Mat3> principal(surface.inertia());
    inertia = density * principal.eigenvalues();
    Mat3 axes = principal.eigenvectors();
    if (axes.determinant() < 0) axes.col(0) *= -1;
    startOrientation_ = Eigen::Quaterniond(axes).normalized();
    surface.translate(-startCentre_);
    surface.rotate(startOrientation_.toRotationMatrix().transpose());
    for (const Vec3& x : surface.nodes) radius_ = std::max(radius_, x.norm());
}

}  // namespace corpuscle::bodies
