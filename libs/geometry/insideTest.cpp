#include "geometry/insideTest.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace corpuscle::geometry {

double windingNumber(const TriangleMesh& mesh, const Vec3& x) {
    double half = 0;  // half of the solid angle (van Oosterom and Strackee 1983)
    for (const auto& [i, j, k] : mesh.triangles) {
        const Vec3 a = mesh.nodes[i] - x, b = mesh.nodes[j] - x, c = mesh.nodes[k] - x;
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        half += std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return half / (2 * std::numbers::pi);
}

InsideTest::InsideTest(const TriangleMesh& mesh) : mesh_(mesh), low_(mesh.nodes.front()), high_(mesh.nodes.front()) {
    for (const Vec3& x : mesh_.nodes) low_ = low_.cwiseMin(x), high_ = high_.cwiseMax(x);
    const Vec3 length = high_ - low_;
    tolerance_ = 1e-12 * length.maxCoeff();
    // About one column per two triangles: half of them face up, half down.
    size_ = std::sqrt(length.x() * length.y() / (0.5 * static_cast<double>(mesh_.triangles.size())));
    columnsX_ = static_cast<int>(length.x() / size_) + 1;
    columnsY_ = static_cast<int>(length.y() / size_) + 1;

    std::vector<std::vector<int>> columns(static_cast<std::size_t>(columnsX_) * columnsY_);
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) {
        const auto& [i, j, k] = mesh_.triangles[t];
        const Vec3 from = mesh_.nodes[i].cwiseMin(mesh_.nodes[j]).cwiseMin(mesh_.nodes[k]) - low_;
        const Vec3 to = mesh_.nodes[i].cwiseMax(mesh_.nodes[j]).cwiseMax(mesh_.nodes[k]) - low_;
        for (int q = static_cast<int>(from.y() / size_); q <= static_cast<int>(to.y() / size_); ++q)
            for (int p = static_cast<int>(from.x() / size_); p <= static_cast<int>(to.x() / size_); ++p)
                columns[q * columnsX_ + p].push_back(t);
    }
    start_.push_back(0);
    for (const std::vector<int>& column : columns) {
        triangles_.insert(triangles_.end(), column.begin(), column.end());
        start_.push_back(static_cast<int>(triangles_.size()));
    }
}

bool InsideTest::inside(const Vec3& x) const {
    if ((x.array() < low_.array()).any() || (x.array() > high_.array()).any()) return false;
    const int column =
        static_cast<int>((x.y() - low_.y()) / size_) * columnsX_ + static_cast<int>((x.x() - low_.x()) / size_);
    const auto robust = [&] { return windingNumber(mesh_, x) > 0.5; };
    int crossings = 0;
    for (int n = start_[column]; n < start_[column + 1]; ++n) {
        const Index3& t = mesh_.triangles[triangles_[n]];
        // Twice the areas of the three triangles that x forms with the sides, projected onto the plane z = 0.
        double s[3];
        bool close = false;
        for (int e = 0; e < 3; ++e) {
            const Vec3 u = mesh_.nodes[t[(e + 1) % 3]] - x, v = mesh_.nodes[t[(e + 2) % 3]] - x;
            s[e] = u.x() * v.y() - u.y() * v.x();
            close |=
                std::abs(s[e]) <= tolerance_ * (std::abs(u.x()) + std::abs(u.y()) + std::abs(v.x()) + std::abs(v.y()));
        }
        const double least = std::min({s[0], s[1], s[2]}), most = std::max({s[0], s[1], s[2]});
        if (!close && least < 0 && most > 0) continue;  // the ray passes by
        if (close) {
            const Vec3 from = mesh_.nodes[t[0]].cwiseMin(mesh_.nodes[t[1]]).cwiseMin(mesh_.nodes[t[2]]);
            const Vec3 to = mesh_.nodes[t[0]].cwiseMax(mesh_.nodes[t[1]]).cwiseMax(mesh_.nodes[t[2]]);
            const double e = tolerance_;
            if (x.x() < from.x() - e || x.x() > to.x() + e || x.y() < from.y() - e || x.y() > to.y() + e) continue;
            return robust();
        }
        const double z = (s[0] * mesh_.nodes[t[0]].z() + s[1] * mesh_.nodes[t[1]].z() + s[2] * mesh_.nodes[t[2]].z()) /
                         (s[0] + s[1] + s[2]);
        if (std::abs(z - x.z()) <= tolerance_) return robust();
        if (z > x.z()) crossings += least > 0 ? 1 : -1;
    }
    return crossings > 0;
}

std::optional<Vec3> InsideTest::imageInside(const Vec3& x, const Periodicity& period) const {
    std::optional<Vec3> found;
    period.forImagesWithin(x, low_, high_, [&](const Vec3& image) {
        if (!found && inside(image)) found = image;
    });
    return found;
}

}  // namespace corpuscle::geometry
