#include "geometry/triangleGrid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace corpuscle::geometry {

Vec3 nearestWeights(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
    // By the Voronoi region of the triangle's corners, sides and face in which x lies.
    const Vec3 ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
    const double d1 = ab.dot(ax), d2 = ac.dot(ax);
    if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
    const double d3 = ab.dot(bx), d4 = ac.dot(bx);
    if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        const double t = d1 / (d1 - d3);
        return {1 - t, t, 0};
    }
    const double d5 = ab.dot(cx), d6 = ac.dot(cx);
    if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        const double t = d2 / (d2 - d6);
        return {1 - t, 0, t};
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {0, 1 - t, t};
    }
    const double sum = va + vb + vc;
    return {va / sum, vb / sum, vc / sum};
}

namespace {
Vec3 combine(const Vec3& w, const Vec3& a, const Vec3& b, const Vec3& c) { return w[0] * a + w[1] * b + w[2] * c; }
}  // namespace

TriangleGrid::TriangleGrid(const TriangleMesh& mesh, double reach)
    : nodes_(mesh.nodes), triangles_(mesh.triangles), reach_(reach), sideEdge_(mesh.triangles.size()), edges_(mesh.edges()) {
    for (int e = 0; e < static_cast<int>(edges_.size()); ++e)
        for (const int t : {edges_[e].left, edges_[e].right}) {
            if (t < 0) continue;
            const Index3& n = triangles_[t];
            for (int s = 0; s < 3; ++s)
                if (std::min(n[s], n[(s + 1) % 3]) == edges_[e].a && std::max(n[s], n[(s + 1) % 3]) == edges_[e].b)
                    sideEdge_[t][s] = e;
        }
    update(mesh.nodes);
}

void TriangleGrid::update(const std::vector<Vec3>& nodes) {
    nodes_ = nodes;
    computeNormalsAndBalls();
    placeCells();
    listCandidates();
}

void TriangleGrid::computeNormalsAndBalls() {
    faceNormal_.resize(triangles_.size());
    nodeNormal_.assign(nodes_.size(), Vec3::Zero());
    edgeNormal_.assign(edges_.size(), Vec3::Zero());
    balls_.resize(triangles_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        const Index3& n = triangles_[t];
        const Vec3 c = (nodes_[n[0]] + nodes_[n[1]] + nodes_[n[2]]) / 3;
        balls_[t] = {c, std::sqrt(std::max({(nodes_[n[0]] - c).squaredNorm(), (nodes_[n[1]] - c).squaredNorm(),
                                            (nodes_[n[2]] - c).squaredNorm()}))};
        faceNormal_[t] = (nodes_[n[1]] - nodes_[n[0]]).cross(nodes_[n[2]] - nodes_[n[0]]).normalized();
        for (int s = 0; s < 3; ++s) {
            edgeNormal_[sideEdge_[t][s]] += faceNormal_[t];
            nodeNormal_[n[s]] +=
                cornerAngle(nodes_[n[s]], nodes_[n[(s + 1) % 3]], nodes_[n[(s + 2) % 3]]) * faceNormal_[t];
        }
    }
}

void TriangleGrid::placeCells() {
    double edge = 0;
    for (const MeshEdge& e : edges_) edge += (nodes_[e.a] - nodes_[e.b]).norm() / static_cast<double>(edges_.size());
    Vec3 low = nodes_.front(), high = nodes_.front();
    for (const Vec3& x : nodes_) low = low.cwiseMin(x), high = high.cwiseMax(x);
    low_ = low - Vec3::Constant(reach_);
    const Vec3 length = high - low + Vec3::Constant(2 * reach_);
    // Smaller cells: shorter lists, but more of them to fill at each update.
    size_ = std::max(edge, 0.5 * reach_);
    for (int axis = 0; axis < 3; ++axis) count_[axis] = static_cast<int>(length[axis] / size_) + 1;
}

int TriangleGrid::cellOf(const Vec3& x) const {
    const Vec3 p = (x - low_) / size_;
    if (!(p.minCoeff() >= 0 && p[0] < count_[0] && p[1] < count_[1] && p[2] < count_[2])) return -1;
    return (static_cast<int>(p[2]) * count_[1] + static_cast<int>(p[1])) * count_[0] + static_cast<int>(p[0]);
}

void TriangleGrid::listCandidates() {
    const double r = size_ * std::sqrt(0.75) * (1 + 1e-12), limit = reach_ + r;
    const int cells = count_[0] * count_[1] * count_[2];
    struct Entry {
        int cell, triangle;
        double nearest;  // lower bound of the distance to the cell's centre
    };
    std::vector<Entry> entries;
    entries.reserve(64 * triangles_.size());
    std::vector<double> bound(cells, std::numeric_limits<double>::infinity());
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
        const auto& [centre, radius] = balls_[t];
        const Vec3 at = (centre - low_) / size_;
        const double span = (limit + radius) / size_, span2 = span * span;
        Index3 first{}, last{};
        for (int axis = 0; axis < 3; ++axis) {
            first[axis] = std::max(0, static_cast<int>(std::ceil(at[axis] - span - 0.5)));
            last[axis] = std::min(count_[axis] - 1, static_cast<int>(std::floor(at[axis] + span - 0.5)));
        }
        for (int k = first[2]; k <= last[2]; ++k)
            for (int j = first[1]; j <= last[1]; ++j) {
                const double dz = k + 0.5 - at.z(), dy = j + 0.5 - at.y(), dyz2 = dz * dz + dy * dy;
                for (int i = first[0]; i <= last[0]; ++i) {
                    const double dx = i + 0.5 - at.x(), d2 = dx * dx + dyz2;
                    if (d2 > span2) continue;
                    const int cell = (k * count_[1] + j) * count_[0] + i;
                    const double d = size_ * std::sqrt(d2);
                    bound[cell] = std::min(bound[cell], d + 2 * r);
                    entries.push_back({cell, t, d - radius});
                }
            }
    }
    start_.assign(cells + 1, 0);
    for (const Entry& e : entries) start_[e.cell + 1] += e.nearest <= bound[e.cell];
    for (int n = 0; n < cells; ++n) start_[n + 1] += start_[n];
    candidates_.resize(start_[cells]);
    std::vector<int> next(start_.begin(), start_.end() - 1);
    for (const Entry& e : entries)
        if (e.nearest <= bound[e.cell]) candidates_[next[e.cell]++] = e.triangle;
}

SurfacePoint TriangleGrid::nearest(const Vec3& x) const {
    SurfacePoint best;
    const int cell = cellOf(x);
    if (cell < 0) return best;
    const int *begin = candidates_.data() + start_[cell], *end = candidates_.data() + start_[cell + 1];
    double least2 = reach_ * reach_;
    for (const int* t = begin; t != end; ++t) least2 = std::min(least2, (x - balls_[*t].centre).squaredNorm() * (1 + 1e-12));
    double least = std::sqrt(least2);
    for (const int* t = begin; t != end; ++t) {
        const auto& [centre, radius] = balls_[*t];
        if ((x - centre).squaredNorm() > (least + radius) * (least + radius)) continue;
        const Index3& n = triangles_[*t];
        const Vec3 &a = nodes_[n[0]], &b = nodes_[n[1]], &c = nodes_[n[2]];
        const Vec3 w = nearestWeights(x, a, b, c);
        const Vec3 p = combine(w, a, b, c);
        const double d2 = (x - p).squaredNorm();
        if (d2 > least2 || (best && d2 == least2)) continue;
        least2 = d2;
        least = std::sqrt(d2);
        best = {*t, w, p, 0};
    }
    if (best) best.distance = (x - best.point).dot(pseudoNormal(best.triangle, best.weights)) < 0 ? -least : least;
    return best;
}

Vec3 TriangleGrid::pseudoNormal(int triangle, const Vec3& w) const {
    for (int s = 0; s < 3; ++s)
        if (w[s] == 1) return nodeNormal_[triangles_[triangle][s]];
    for (int s = 0; s < 3; ++s)
        if (w[s] == 0) return edgeNormal_[sideEdge_[triangle][(s + 1) % 3]];  // the side opposite to node s
    return faceNormal_[triangle];
}

}  // namespace corpuscle::geometry
