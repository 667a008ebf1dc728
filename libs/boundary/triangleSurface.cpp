#include "boundary/triangleSurface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace corpuscle::boundary {

namespace {

constexpr double gridNodes = 250000;  // at most about this many
constexpr double bandInSpacings = 4;

// The mesh with its images in the boxes around this one, along the periodic axes.
geometry::TriangleMesh withImages(const geometry::TriangleMesh& mesh, const particles::Box& box) {
    geometry::TriangleMesh all;
    const auto reach = [&](int k) { return box.periodic[static_cast<std::size_t>(k)] ? 1 : 0; };
    for (int i = -reach(0); i <= reach(0); ++i)
        for (int j = -reach(1); j <= reach(1); ++j)
            for (int k = -reach(2); k <= reach(2); ++k) {
                const auto first = static_cast<int>(all.nodes.size());
                const Vec3 shift = box.size().cwiseProduct(Vec3(i, j, k));
                for (const Vec3& x : mesh.nodes) all.nodes.push_back(x + shift);
                for (const Index3& t : mesh.triangles)
                    all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
            }
    return all;
}

}  // namespace

TriangleSurface::TriangleSurface(const geometry::TriangleMesh& mesh, FluidSide side, const particles::Box& fluid)
    : box_(fluid),
      sign_(side == FluidSide::inside ? -1 : 1),
      area_(mesh.area()),
      tree_(withImages(mesh, fluid), std::numeric_limits<double>::infinity()) {
    // The grid covers the box and, across walls, half of it again for the particles of walls.
    Vec3 extent = fluid.size();
    low_ = fluid.low;
    for (int k = 0; k < 3; ++k)
        if (!fluid.periodic[static_cast<std::size_t>(k)]) low_[k] -= 0.25 * extent[k], extent[k] *= 1.5;
    spacing_ = std::cbrt(extent.prod() / gridNodes);
    band_ = bandInSpacings * spacing_;
    std::size_t all = 1;
    for (int k = 0; k < 3; ++k) {
        count_[static_cast<std::size_t>(k)] = static_cast<int>(std::ceil(extent[k] / spacing_)) + 1;
        all *= static_cast<std::size_t>(count_[static_cast<std::size_t>(k)]);
    }
    values_.assign(all, std::numeric_limits<float>::quiet_NaN());
}

Vec3 TriangleSurface::intoBox(Vec3 x) const {
    for (int k = 0; k < 3; ++k)
        if (box_.periodic[static_cast<std::size_t>(k)]) x[k] = box_.wrap(x[k], k);
    return x;
}

double TriangleSurface::exact(const Vec3& x, double within) const {
    geometry::SurfacePoint at = tree_.nearest(x, within);
    if (!at) at = tree_.nearest(x);  // rounding at the limit
    return sign_ * at.distance;
}

double TriangleSurface::node(const Index3& at) const {
    const auto k =
        (static_cast<std::size_t>(at[2]) * static_cast<std::size_t>(count_[1]) + static_cast<std::size_t>(at[1])) *
            static_cast<std::size_t>(count_[0]) +
        static_cast<std::size_t>(at[0]);
    float& value = values_[k];
    if (std::isnan(value))
        value = static_cast<float>(
            exact(low_ + spacing_ * Vec3(at[0], at[1], at[2]), std::numeric_limits<double>::infinity()));
    return value;
}

double TriangleSurface::distance(const Vec3& point) const {
    const Vec3 x = intoBox(point);
    Index3 cell{};
    double part[3];
    for (int k = 0; k < 3; ++k) {
        const double place = (x[k] - low_[k]) / spacing_;
        const auto axis = static_cast<std::size_t>(k);
        if (!(place >= 0 && place < count_[axis] - 1)) return exact(x, std::numeric_limits<double>::infinity());
        cell[axis] = static_cast<int>(place), part[k] = place - cell[axis];
    }
    double value = 0;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        Index3 at = cell;
        for (int k = 0; k < 3; ++k) {
            const bool upper = (corner >> k) & 1;
            weight *= upper ? part[k] : 1 - part[k];
            at[static_cast<std::size_t>(k)] += upper;
        }
        if (weight > 0) value += weight * node(at);
    }
    if (std::abs(value) > band_) return value;
    // A distance differs from that at a node of this grid cell by at most the diagonal of the cell.
    return exact(x, std::abs(value) + std::sqrt(3.0) * spacing_);
}

Vec3 TriangleSurface::normal(const Vec3& point) const {
    const Vec3 x = intoBox(point);
    const geometry::SurfacePoint at = tree_.nearest(x);
    if (std::abs(at.distance) > 1e-9 * spacing_) return sign_ * (x - at.point) / at.distance;
    // On the surface: the direction in which the distance grows.
    Vec3 gradient;
    for (int k = 0; k < 3; ++k) {
        const Vec3 step = 1e-3 * spacing_ * Vec3::Unit(k);
        const double infinite = std::numeric_limits<double>::infinity();
        gradient[k] = exact(x + step, infinite) - exact(x - step, infinite);
    }
    return gradient.normalized();
}

Section sectionAt(const geometry::TriangleMesh& mesh, double x) {
    Section found{0, 0};
    for (const Index3& t : mesh.triangles) {
        // Of an outward oriented mesh these segments run clockwise around the section, seen from +x, or all the other
        // way round; the sign is settled by the whole.
        Vec3 ends[2];
        int count = 0;
        bool rises = false;
        for (std::size_t s = 0; s < 3; ++s) {
            const Vec3 &a = mesh.nodes[static_cast<std::size_t>(t[s])],
                       &b = mesh.nodes[static_cast<std::size_t>(t[(s + 1) % 3])];
            if ((a[0] < x) == (b[0] < x)) continue;
            const Vec3 at = a + (x - a[0]) / (b[0] - a[0]) * (b - a);
            if (count < 2) ends[count] = at;
            if (count == 0) rises = a[0] < x;
            ++count;
        }
        if (count != 2) continue;
        if (!rises) std::swap(ends[0], ends[1]);
        found.perimeter += (ends[1] - ends[0]).norm();
        found.area += 0.5 * (ends[0][1] * ends[1][2] - ends[0][2] * ends[1][1]);
    }
    found.area = std::abs(found.area);
    return found;
}

double volumeWithin(const geometry::TriangleMesh& mesh) {
    double volume = 0;  // of the field (0, y, z)/2 through the surface; it has no flux through ends normal to x
    for (const Index3& t : mesh.triangles) {
        const Vec3 &a = mesh.nodes[static_cast<std::size_t>(t[0])], &b = mesh.nodes[static_cast<std::size_t>(t[1])],
                   &c = mesh.nodes[static_cast<std::size_t>(t[2])];
        const Vec3 normal = 0.5 * (b - a).cross(c - a), middle = (a + b + c) / 3;
        volume += 0.5 * (middle[1] * normal[1] + middle[2] * normal[2]);
    }
    return volume;
}

// A half of the lengths of the edges times the angles by which the normal turns there.
double meanCurvature(const geometry::TriangleMesh& mesh) {
    const auto normalOf = [&](int t) {
        const Index3& n = mesh.triangles[static_cast<std::size_t>(t)];
        const Vec3& a = mesh.nodes[static_cast<std::size_t>(n[0])];
        return Vec3((mesh.nodes[static_cast<std::size_t>(n[1])] - a)
                        .cross(mesh.nodes[static_cast<std::size_t>(n[2])] - a)
                        .normalized());
    };
    double sum = 0;
    for (const geometry::MeshEdge& edge : mesh.edges()) {
        if (edge.left < 0 || edge.right < 0) continue;
        const Vec3 along = mesh.nodes[static_cast<std::size_t>(edge.b)] - mesh.nodes[static_cast<std::size_t>(edge.a)];
        const Vec3 left = normalOf(edge.left), right = normalOf(edge.right);
        // The left triangle runs through the edge from a to b, so that it lies to the left seen from outside.
        const double sine = right.cross(left).dot(along) / along.norm();
        sum += 0.5 * along.norm() * std::atan2(-sine, left.dot(right));
    }
    return sum;
}

}  // namespace corpuscle::boundary
