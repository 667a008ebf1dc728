#include "observers/sectionShape.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numbers>

namespace corpuscle::observers {

namespace {

// Extents of the cross-section with the plane through `centre`, along and across the direction `axis` of the shear
// plane; NaN where the plane cuts no triangle, as between two pieces of a cell.
Eigen::Vector2d sectionExtents(const geometry::TriangleMesh& mesh, const ShearPlane& plane, const Vec3& centre,
                               const Eigen::Vector2d& axis) {
    const Eigen::Vector2d across(-axis[1], axis[0]);
    Eigen::Array2d low = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
    const int v = plane.vorticity();
    for (const Index3& triangle : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 a = mesh.nodes[triangle[k]] - centre, b = mesh.nodes[triangle[(k + 1) % 3]] - centre;
            if ((a[v] < 0) == (b[v] < 0)) continue;
            const Eigen::Vector2d p = plane.in(a + a[v] / (a[v] - b[v]) * (b - a));
            const Eigen::Array2d at(p.dot(axis), p.dot(across));
            low = low.min(at), high = high.max(at);
        }
    if (!(low <= high).all()) return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
    return high - low;
}

}  // namespace

SectionShape sectionShape(const geometry::TriangleMesh& mesh, const ShearPlane& plane) {
    if (mesh.triangles.empty()) {
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        return {none, none, none, none, none, none, Vec3::Constant(none)};
    }
    SectionShape shape;
    shape.centroid = mesh.centroid();
    const Mat3 inertia = mesh.inertia();
    const Mat3 inverse = (0.5 * inertia.trace() * Mat3::Identity() - inertia).inverse();
    const int g = plane.gradient;
    Eigen::Matrix2d section;
    section << inverse(0, 0), inverse(0, g), inverse(g, 0), inverse(g, g);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(section / section.trace());
    const Eigen::Vector2d semi = axes.eigenvalues().cwiseSqrt().cwiseInverse();
    shape.D12_inertia = (semi[0] - semi[1]) / (semi[0] + semi[1]);
    Eigen::Vector2d axis = axes.eigenvectors().col(0);
    if (axis[0] < 0 || (axis[0] == 0 && axis[1] < 0)) axis = -axis;
    shape.inclination = std::atan2(axis[1], axis[0]);

    const Eigen::Vector2d extents = sectionExtents(mesh, plane, shape.centroid, axis);
    shape.length = extents[0];
    shape.height = extents[1];
    shape.D12_extent = std::abs(shape.length - shape.height) / (shape.length + shape.height);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& x : mesh.nodes)
        low = std::min(low, x[plane.vorticity()]), high = std::max(high, x[plane.vorticity()]);
    shape.width = high - low;
    return shape;
}

double materialRotation(std::span<const Vec3> rest, std::span<const Vec3> now, const ShearPlane& plane) {
    Vec3 restMean = Vec3::Zero(), mean = Vec3::Zero();
    for (const Vec3& r : rest) restMean += r;
    for (const Vec3& q : now) mean += q;
    restMean /= static_cast<double>(rest.size());
    mean /= static_cast<double>(now.size());
    double along = 0, across = 0;
    for (std::size_t n = 0; n < now.size(); ++n) {
        const Eigen::Vector2d r = plane.in(rest[n] - restMean), q = plane.in(now[n] - mean);
        along += r.dot(q);
        across += r[1] * q[0] - r[0] * q[1];
    }
    return std::atan2(across, along);
}

double flowAngle(const Vec3& fromCentre, const ShearPlane& plane) {
    const Eigen::Vector2d p = plane.in(fromCentre);
    return std::atan2(-p[1], p[0]);
}

double followed(double last, double angle, double period) { return last + std::remainder(angle - last, period); }

}  // namespace corpuscle::observers
