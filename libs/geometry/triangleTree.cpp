#include "geometry/triangleTree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

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

// Boxes and planes further away than the nearest point by this factor (of squared distances) are still searched, so
// that of the triangles that share this point the one with the lowest number is found, whatever the order of the tree.
constexpr double slack = 1 + 1e-12;

Vec3 combine(const Vec3& w, const Vec3& a, const Vec3& b, const Vec3& c) { return w[0] * a + w[1] * b + w[2] * c; }
}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh, double reach)
    : nodes_(mesh.nodes), reach_(reach), sideEdge_(mesh.triangles.size()), edges_(mesh.edges()) {
    std::vector<Vec3> centres;
    for (const auto& [i, j, k] : mesh.triangles) centres.push_back((nodes_[i] + nodes_[j] + nodes_[k]) / 3);
    number_.resize(mesh.triangles.size());
    std::iota(number_.begin(), number_.end(), 0);
    split(0, static_cast<int>(number_.size()), centres, number_);
    place_.resize(number_.size());
    for (std::size_t t = 0; t < number_.size(); ++t) {
        triangles_.push_back(mesh.triangles[number_[t]]);
        place_[number_[t]] = static_cast<int>(t);
    }
    for (const MeshEdge& edge : edges_) {
        if (edge.left >= 0 && edge.right >= 0) continue;
        isBorderNode_.resize(nodes_.size(), 0);
        isBorderNode_[edge.a] = isBorderNode_[edge.b] = 1;
    }
    for (int e = 0; e < static_cast<int>(edges_.size()); ++e)
        for (const int t : {edges_[e].left, edges_[e].right}) {
            if (t < 0) continue;
            const Index3& n = mesh.triangles[t];
            for (int s = 0; s < 3; ++s)
                if (std::minmax({n[s], n[(s + 1) % 3]}) == std::pair{edges_[e].a, edges_[e].b})
                    sideEdge_[place_[t]][s] = e;
        }
    update(mesh.nodes);
}

void TriangleTree::split(int first, int count, const std::vector<Vec3>& centres, std::vector<int>& order) {
    const int self = static_cast<int>(boxes_.size());
    boxes_.push_back({Vec3::Zero(), Vec3::Zero(), first, count, 0});
    if (count <= 4) return;
    Vec3 low = centres[order[first]], high = low;
    for (int t = first; t < first + count; ++t)
        low = low.cwiseMin(centres[order[t]]), high = high.cwiseMax(centres[order[t]]);
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const int half = count / 2;
    const auto begin = order.begin() + first;
    std::nth_element(begin, begin + half, begin + count, [&](int s, int t) {
        return centres[s][axis] < centres[t][axis] || (centres[s][axis] == centres[t][axis] && s < t);
    });
    boxes_[self].count = 0;
    split(first, half, centres, order);
    boxes_[self].second = static_cast<int>(boxes_.size());
    split(first + half, count - half, centres, order);
}

void TriangleTree::update(const std::vector<Vec3>& nodes) {
    nodes_ = nodes;
    computeNormals();
    computeBoxes();
}

void TriangleTree::computeNormals() {
    faceNormal_.resize(triangles_.size());
    nodeNormal_.assign(nodes_.size(), Vec3::Zero());
    edgeNormal_.assign(edges_.size(), Vec3::Zero());
    for (const int t : place_) {  // in the order of the mesh, whatever that of the tree
        const Index3& n = triangles_[t];
        faceNormal_[t] = (nodes_[n[1]] - nodes_[n[0]]).cross(nodes_[n[2]] - nodes_[n[0]]).normalized();
        for (int s = 0; s < 3; ++s) {
            edgeNormal_[sideEdge_[t][s]] += faceNormal_[t];
            nodeNormal_[n[s]] +=
                cornerAngle(nodes_[n[s]], nodes_[n[(s + 1) % 3]], nodes_[n[(s + 2) % 3]]) * faceNormal_[t];
        }
    }
}

void TriangleTree::computeBoxes() {
    for (int n = static_cast<int>(boxes_.size()) - 1; n >= 0; --n) {
        Box& box = boxes_[n];
        if (box.count == 0) {
            box.low = boxes_[n + 1].low.cwiseMin(boxes_[box.second].low);
            box.high = boxes_[n + 1].high.cwiseMax(boxes_[box.second].high);
            continue;
        }
        box.low = box.high = nodes_[triangles_[box.first][0]];
        for (int t = box.first; t < box.first + box.count; ++t)
            for (const int node : triangles_[t]) {
                box.low = box.low.cwiseMin(nodes_[node]);
                box.high = box.high.cwiseMax(nodes_[node]);
            }
    }
}

SurfacePoint TriangleTree::nearest(const Vec3& x, double within) const {
    SurfacePoint best;
    const double most = std::min(reach_, within);
    double least2 = most * most;
    struct Waiting {
        int box;
        double distance2;
    };
    std::array<Waiting, 64> stack;  // the tree is balanced: its depth is log2 of the number of triangles
    int waiting = 0, at = -1;
    stack[waiting++] = {0, boxes_[0].distance2(x)};
    while (waiting > 0) {
        const Waiting next = stack[--waiting];
        if (next.distance2 > slack * least2) continue;
        int n = next.box;
        while (n >= 0) {
            const Box& box = boxes_[n];
            if (box.count > 0) {
                for (int t = box.first; t < box.first + box.count; ++t) {
                    const Index3& corner = triangles_[t];
                    const Vec3 &a = nodes_[corner[0]], &b = nodes_[corner[1]], &c = nodes_[corner[2]];
                    const double height = (x - a).dot(faceNormal_[t]);
                    if (height * height > slack * least2) continue;
                    const Vec3 w = nearestWeights(x, a, b, c);
                    const Vec3 p = combine(w, a, b, c);
                    const double d2 = (x - p).squaredNorm();
                    if (d2 > least2 || (at >= 0 && d2 == least2 && number_[t] > number_[at])) continue;
                    least2 = d2;
                    at = t;
                    best.weights = w;
                    best.point = p;
                }
                break;
            }
            const double one = boxes_[n + 1].distance2(x), two = boxes_[box.second].distance2(x);
            const bool firstNearer = one <= two;
            if (std::max(one, two) <= slack * least2)
                stack[waiting++] = {firstNearer ? box.second : n + 1, std::max(one, two)};
            n = std::min(one, two) > slack * least2 ? -1 : firstNearer ? n + 1 : box.second;
        }
    }
    if (at < 0) return {};
    best.triangle = number_[at];
    const double distance = std::sqrt(least2);
    best.distance = (x - best.point).dot(pseudoNormal(at, best.weights)) < 0 ? -distance : distance;
    return best;
}

bool TriangleTree::isOnBorder(const SurfacePoint& at) const {
    if (isBorderNode_.empty()) return false;
    const int triangle = place_[at.triangle];
    for (int s = 0; s < 3; ++s)
        if (at.weights[s] == 1) return isBorderNode_[triangles_[triangle][s]] != 0;
    for (int s = 0; s < 3; ++s)
        if (at.weights[s] == 0) {
            const MeshEdge& edge = edges_[sideEdge_[triangle][(s + 1) % 3]];
            return edge.left < 0 || edge.right < 0;
        }
    return false;
}

Vec3 TriangleTree::pseudoNormal(int triangle, const Vec3& w) const {
    for (int s = 0; s < 3; ++s)
        if (w[s] == 1) return nodeNormal_[triangles_[triangle][s]];
    for (int s = 0; s < 3; ++s)
        if (w[s] == 0) return edgeNormal_[sideEdge_[triangle][(s + 1) % 3]];  // the side opposite to node s
    return faceNormal_[triangle];
}

}  // namespace corpuscle::geometry
