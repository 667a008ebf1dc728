#include "geometry/triangleMesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace corpuscle::geometry {

double cornerAngle(const Vec3& at, const Vec3& next, const Vec3& previous) {
    const Vec3 u = next - at, v = previous - at;
    return std::atan2(u.cross(v).norm(), u.dot(v));
}

Mat3 rotationFromZ(const Vec3& axis) {
    return Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis.normalized()).toRotationMatrix();
}

double TriangleMesh::area() const {
    double twice = 0;
    for (const auto& [i, j, k] : triangles) twice += (nodes[j] - nodes[i]).cross(nodes[k] - nodes[i]).norm();
    return twice / 2;
}

namespace {
// Moments of the solid about `origin`, which is chosen near the mesh to avoid cancellation.
struct Moments {
    double volume = 0;
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();
};
Moments moments(const TriangleMesh& mesh, const Vec3& origin) {
    Moments m;
    for (const auto& [i, j, k] : mesh.triangles) {
        const Vec3 a = mesh.nodes[i] - origin, b = mesh.nodes[j] - origin, c = mesh.nodes[k] - origin, s = a + b + c;
        const double D = a.dot(b.cross(c));
        m.volume += D / 6;
        m.first += D / 24 * s;
        m.second += D / 120 * (s * s.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
    }
    return m;
}
Vec3 nearby(const TriangleMesh& mesh) { return mesh.nodes.empty() ? Vec3(Vec3::Zero()) : mesh.nodes.front(); }
}  // namespace

double TriangleMesh::volume() const { return moments(*this, nearby(*this)).volume; }

Vec3 TriangleMesh::centroid() const {
    const Vec3 origin = nearby(*this);
    const Moments m = moments(*this, origin);
    return origin + m.first / m.volume;
}

Mat3 TriangleMesh::inertia() const {
    const Moments m = moments(*this, centroid());
    return m.second.trace() * Mat3::Identity() - m.second;
}

std::vector<MeshEdge> TriangleMesh::edges() const {
    std::vector<MeshEdge> sides;
    sides.reserve(triangles.size() * 3);
    for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
        for (int s = 0; s < 3; ++s) {
            const int a = triangles[t][s], b = triangles[t][(s + 1) % 3];
            sides.push_back(a < b ? MeshEdge{a, b, t, -1} : MeshEdge{b, a, -1, t});
        }
    std::sort(sides.begin(), sides.end(), [](const MeshEdge& p, const MeshEdge& q) {
        return std::array{p.a, p.b, p.right, p.left} < std::array{q.a, q.b, q.right, q.left};
    });
    std::vector<MeshEdge> result;
    result.reserve(sides.size() / 2);
    for (const MeshEdge& side : sides) {
        const bool second = !result.empty() && result.back().a == side.a && result.back().b == side.b;
        if (!second) {
            result.push_back(side);
        } else {
            result.back().left = std::max(result.back().left, side.left);
            result.back().right = std::max(result.back().right, side.right);
        }
    }
    return result;
}

std::vector<double> TriangleMesh::vertexAreas() const {
    std::vector<double> areas(nodes.size(), 0.0);
    for (const auto& t : triangles) {
        const double third = (nodes[t[1]] - nodes[t[0]]).cross(nodes[t[2]] - nodes[t[0]]).norm() / 6;
        for (int n : t) areas[n] += third;
    }
    return areas;
}

std::vector<Vec3> TriangleMesh::vertexNormals() const {
    std::vector<Vec3> normals(nodes.size(), Vec3::Zero());
    for (const auto& t : triangles) {
        const Vec3 n = (nodes[t[1]] - nodes[t[0]]).cross(nodes[t[2]] - nodes[t[0]]).normalized();
        for (int s = 0; s < 3; ++s)
            normals[t[s]] += cornerAngle(nodes[t[s]], nodes[t[(s + 1) % 3]], nodes[t[(s + 2) % 3]]) * n;
    }
    for (Vec3& n : normals) n.normalize();
    return normals;
}

void TriangleMesh::translate(const Vec3& by) {
    for (Vec3& x : nodes) x += by;
}

void TriangleMesh::rotate(const Mat3& rotation, const Vec3& about) {
    for (Vec3& x : nodes) x = about + rotation * (x - about);
}

void TriangleMesh::scale(double factor) {
    for (Vec3& x : nodes) x *= factor;
}

void TriangleMesh::flip() {
    for (Index3& t : triangles) std::swap(t[1], t[2]);
}

}  // namespace corpuscle::geometry
