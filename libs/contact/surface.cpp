#include "contact/surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace corpuscle::contact {
namespace {

Edge sideOf(const Index3& triangle, std::size_t k) {
    const int a = triangle[k], b = triangle[(k + 1) % 3];
    return {std::min(a, b), std::max(a, b)};
}

double areaOf(std::span<const Vec3> x, const Index3& t) {
    return 0.5 * (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).norm();
}

}  // namespace

Surface::Surface(std::span<const Vec3> reference, std::span<const Index3> triangles)
    : triangles_(triangles.begin(), triangles.end()), nodeArea_(reference.size(), 0.0) {
    findEdges();
    setAreas(reference);
    setCoefficients();
}

void Surface::findEdges() {
    edges_.reserve(3 * triangles_.size());
    for (const Index3& t : triangles_)
        for (std::size_t k = 0; k < 3; ++k) edges_.push_back(sideOf(t, k));
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    sides_.resize(triangles_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto place = std::lower_bound(edges_.begin(), edges_.end(), sideOf(triangles_[t], k));
            sides_[t][k] = static_cast<int>(place - edges_.begin());
        }
}

void Surface::setAreas(std::span<const Vec3> reference) {
    edgeWidth_.assign(edges_.size(), 0.0);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        const double third = areaOf(reference, triangles_[t]) / 3;
        for (std::size_t k = 0; k < 3; ++k) {
            nodeArea_[triangles_[t][k]] += third;
            edgeWidth_[sides_[t][k]] += third;
        }
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        const double length = (reference[edges_[e][1]] - reference[edges_[e][0]]).norm();
        edgeWidth_[e] = length > 0 ? edgeWidth_[e] / length : 0;
    }
    double area = 0, count = 0;
    for (const double one : nodeArea_) area += one, count += one > 0;
    meanNodeArea_ = count > 0 ? area / count : 0;
}

void Surface::setCoefficients() {
    edgeCoefficient_.assign(edges_.size(), 1);
    nodeCoefficient_.assign(nodeArea_.size(), 1);
    for (std::size_t t = 0; t < triangles_.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) --edgeCoefficient_[sides_[t][k]], --nodeCoefficient_[triangles_[t][k]];
    for (std::size_t e = 0; e < edges_.size(); ++e)
        for (const int node : edges_[e]) nodeCoefficient_[node] -= edgeCoefficient_[e];
}

double largestReach(std::span<const Vec3> nodes, std::span<const Index3> triangles) {
    double least = std::numeric_limits<double>::infinity();
    for (const Index3& t : triangles) {
        double longest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double length = (nodes[t[(k + 1) % 3]] - nodes[t[k]]).norm();
            least = std::min(least, 0.4 * length);
            longest = std::max(longest, length);
        }
        least = std::min(least, longest > 0 ? 0.8 * 2 * areaOf(nodes, t) / longest : 0);
    }
    return least;
}

}  // namespace corpuscle::contact
