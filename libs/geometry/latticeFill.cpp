#include "geometry/latticeFill.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <unordered_map>

#include "core/error.hpp"
#include "geometry/boundsIndex.hpp"
#include "geometry/periodicSurface.hpp"

namespace corpuscle::geometry {
namespace {

constexpr double largestDeviation = 1e-3;

// All periodic images of the nodes that lie between low and high.
std::vector<Vec3> imagesNear(const std::vector<Vec3>& nodes, const Vec3& low, const Vec3& high,
                             const Periodicity& period) {
    std::vector<Vec3> images;
    for (const Vec3& x : nodes)
        period.forImagesWithin(x, low, high, [&](const Vec3& image) { images.push_back(image); });
    return images;
}

int countAlong(int axis, double length, double dx) {
    const double n = std::round(length / dx);
    if (n >= 1 && std::abs(length / n / dx - 1) <= largestDeviation) return static_cast<int>(n);
    const double below = std::max(1.0, std::floor(length / dx)), above = below + 1;
    throw Failure(
        ExitCode::invalidCase,
        fmt::format(
            "the box is {:.6g} um long along {}, which is no whole number of spacings of {:.6g} um. Take {:.6g} um "
            "({} spacings) or {:.6g} um ({} spacings), or a spacing of {:.6g} um",
            length * 1e6, "xyz"[axis], dx * 1e6, below * dx * 1e6, below, above * dx * 1e6, above,
            length / std::max(n, 1.0) * 1e6));
}

}  // namespace

Lattice fillLattice(const LatticeBox& box) {
    if (!(box.spacing > 0)) throw Failure(ExitCode::invalidCase, "the particle spacing must be greater than 0");
    if (!(box.jitter >= 0 && box.jitter < 0.5))
        throw Failure(ExitCode::invalidCase, "the jitter must be from 0 to below 0.5");
    Lattice lattice;
    Index3 from{0, 0, 0}, to{};
    for (int axis = 0; axis < 3; ++axis) {
        to[axis] = lattice.count[axis] = countAlong(axis, box.size[axis], box.spacing);
        lattice.spacing[axis] = box.size[axis] / lattice.count[axis];
    }
    for (int axis = 0; axis < 3; ++axis) from[axis] -= box.layers[axis], to[axis] += box.layers[axis];

    std::mt19937_64 random(box.seed);
    const auto shift = [&] {  // uniform in +-jitter, the same on every machine
        return box.jitter * (static_cast<double>(random() >> 11) * 0x1p-52 - 1);
    };
    for (int k = from[2]; k < to[2]; ++k)
        for (int j = from[1]; j < to[1]; ++j)
            for (int i = from[0]; i < to[0]; ++i) {
                Vec3 cell(i + 0.5, j + 0.5, k + 0.5);
                const auto place = [&]() -> Vec3 {
                    return box.centre - box.size / 2 + cell.cwiseProduct(lattice.spacing);
                };
                const PointKind kind = box.kindOf ? box.kindOf(place()) : PointKind::fluid;
                if (kind == PointKind::nothing) continue;
                if (box.jitter > 0 && kind == PointKind::fluid) {
                    const Vec3 onLattice = cell;
                    for (int axis = 0; axis < 3; ++axis) cell[axis] += shift();
                    // A point that would be displaced behind a curved wall stays where it is.
                    if (box.kindOf && box.kindOf(place()) != PointKind::fluid) cell = onLattice;
                }
                lattice.points.push_back(place());
                lattice.kinds.push_back(kind);
            }
    return lattice;
}

std::vector<int> carve(const std::vector<Vec3>& points, const std::vector<Vec3>& nodes, std::size_t count,
                       const Periodicity& period) {
    if (count == 0 || nodes.empty()) return {};
    if (count > points.size())
        throw Failure(ExitCode::invalidCase,
                      fmt::format("the membranes take the place of {} fluid particles, but there are only {}: "
                                  "take a smaller spacing or a larger box",
                                  count, points.size()));
    // Nodes are kept in hashed cells of size s: the distance of a point that finds a node within s is exact. s is
    // doubled until enough points have found one.
    Vec3 low = points.front(), high = points.front();
    for (const Vec3& x : points) low = low.cwiseMin(x), high = high.cwiseMax(x);
    double s = std::cbrt((high - low).prod() / static_cast<double>(points.size()));
    s = std::max(s, 1e-6 * (high - low).norm());
    std::vector<double> distance(points.size());
    for (std::size_t found = 0; found < count; s *= 2) {
        const std::vector<Vec3> near = imagesNear(nodes, low - Vec3::Constant(s), high + Vec3::Constant(s), period);
        const auto cell = [&](const Vec3& x, int di, int dj, int dk) {
            const auto part = [&](int axis, int d) {
                return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor((x[axis] - low[axis]) / s)) + d +
                                                  (1 << 20)) &
                       0x1fffff;
            };
            return part(0, di) | part(1, dj) << 21 | part(2, dk) << 42;
        };
        std::unordered_map<std::uint64_t, std::vector<int>> cells;
        for (int n = 0; n < static_cast<int>(near.size()); ++n) cells[cell(near[n], 0, 0, 0)].push_back(n);
        found = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            double least2 = std::numeric_limits<double>::infinity();
            const Vec3& x = points[i];
            for (int n = 0; n < 27; ++n)
                if (const auto in = cells.find(cell(x, n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1)); in != cells.end())
                    for (int node : in->second) least2 = std::min(least2, (x - near[node]).squaredNorm());
            distance[i] = std::sqrt(least2);
            found += distance[i] <= s;
        }
    }
    std::vector<int> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    const auto nearer = [&](int i, int j) {
        return distance[i] < distance[j] || (distance[i] == distance[j] && i < j);
    };
    std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count) - 1, order.end(), nearer);
    order.resize(count);
    std::sort(order.begin(), order.end());
    return order;
}

std::vector<int> tagSides(const std::vector<Vec3>& points, const std::vector<TriangleMesh>& meshes,
                          const Periodicity& period) {
    std::vector<int> side(points.size(), 0);
    const auto near = pointsNear(points, meshes, 0, period);
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const InsideTest test(meshes[m]);
        for (const std::size_t i : near[m]) {
            if (!test.inside(points[i], period)) continue;
            if (side[i] != 0)
                throw Failure(
                    ExitCode::invalidCase,
                    fmt::format("cells {} and {} overlap at ({:.4g}, {:.4g}, {:.4g}) um: move them apart", side[i],
                                m + 1, points[i].x() * 1e6, points[i].y() * 1e6, points[i].z() * 1e6));
            side[i] = static_cast<int>(m) + 1;
        }
    }
    return side;
}

std::size_t holdOff(std::vector<Vec3>& points, const std::vector<int>& side, const std::vector<TriangleMesh>& meshes,
                    double least, const Periodicity& period) {
    std::size_t moved = 0;
    const auto near = pointsNear(points, meshes, 2 * least, period);
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const TriangleMesh& mesh = meshes[m];
        const TriangleTree grid(mesh, least);
        const NearestImages surface(grid, mesh.nodes, period);
        for (const std::size_t i : near[m]) {
            const auto [at, x] = surface.nearest(points[i]);
            const double own = side[i] == static_cast<int>(m) + 1 ? -1 : 1;
            if (!at || own * at.distance >= least) continue;
            const Index3& t = mesh.triangles[static_cast<std::size_t>(at.triangle)];
            const Vec3 &a = mesh.nodes[static_cast<std::size_t>(t[0])], &b = mesh.nodes[static_cast<std::size_t>(t[1])],
                       &c = mesh.nodes[static_cast<std::size_t>(t[2])];
            const bool apart = std::abs(at.distance) > 1e-4 * least;
            const Vec3 normal = apart ? Vec3((x - at.point) / at.distance) : (b - a).cross(c - a).normalized();
            points[i] += at.point + own * least * normal - x;
            ++moved;
        }
    }
    return moved;
}

}  // namespace corpuscle::geometry
