// Flat sheets: exact area, one border, normals along z, well-shaped triangles; random displacements that do not move
// the border.
#include "geometry/flatSheet.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numbers>

#include "core/error.hpp"

namespace corpuscle::geometry {
namespace {

struct Border {
    std::vector<char> isOn;
    int edges = 0, inside = 0;
};

// Fails if two triangles lie on the same side of an edge, or if more than two share it.
Border borderOf(const TriangleMesh& mesh) {
    std::map<std::pair<int, int>, int> sides;
    for (const Index3& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            EXPECT_EQ(++sides[std::pair(t[k], t[(k + 1) % 3])], 1);
        }
    }
    Border border{std::vector<char>(mesh.nodes.size(), 0)};
    for (const auto& [edge, count] : sides) {
        if (sides.contains({edge.second, edge.first})) {
            ++border.inside;
        } else {
            ++border.edges;
            border.isOn[edge.first] = border.isOn[edge.second] = 1;
        }
    }
    return border;
}

double angleMin(const TriangleMesh& mesh) {
    double least = 180;
    for (const Index3& t : mesh.triangles) {
        const Vec3 normal = (mesh.nodes[t[1]] - mesh.nodes[t[0]]).cross(mesh.nodes[t[2]] - mesh.nodes[t[0]]);
        EXPECT_GT(normal[2], 0);
        for (int k = 0; k < 3; ++k) {
            least =
                std::min(least, cornerAngle(mesh.nodes[t[k]], mesh.nodes[t[(k + 1) % 3]], mesh.nodes[t[(k + 2) % 3]]) *
                                    180 / std::numbers::pi);
        }
    }
    return least;
}

TEST(FlatSheet, IsAWholeSheetWithOneBorder) {
    for (const bool round : {false, true}) {
        const TriangleMesh mesh = round ? disc(2, 0.2) : rectangle(3, 2, 0.2);
        const Border border = borderOf(mesh);
        const int edges = border.edges + border.inside / 2;
        EXPECT_EQ(static_cast<int>(mesh.nodes.size()) - edges + static_cast<int>(mesh.triangles.size()), 1) << "Euler";
        EXPECT_EQ(std::count(border.isOn.begin(), border.isOn.end(), 1), border.edges) << "one loop";
        const double polygon = 0.5 * 60 * 4 * std::sin(2 * std::numbers::pi / 60);
        EXPECT_NEAR(mesh.area(), round ? polygon : 6, 1e-12);
        EXPECT_GT(angleMin(mesh), round ? 40 : 29);
    }
}

TEST(FlatSheet, DisorderLeavesTheBorderAndNoTriangleTurned) {
    const TriangleMesh regular = rectangle(3, 2, 0.2);
    TriangleMesh mesh = regular, same = regular;
    disorder(mesh, 0.2, 3);
    disorder(same, 0.2, 3);
    const Border border = borderOf(mesh);
    int moved = 0;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        EXPECT_EQ(mesh.nodes[n], same.nodes[n]);
        EXPECT_EQ(mesh.nodes[n] != regular.nodes[n], !border.isOn[n]);
        moved += mesh.nodes[n] != regular.nodes[n];
    }
    EXPECT_GT(moved, 100);
    EXPECT_GT(angleMin(mesh), 12);
    EXPECT_NEAR(mesh.area(), 6, 1e-12);
}

TEST(FlatSheet, RefusesTooCoarseAMesh) {
    EXPECT_THROW(rectangle(3, 2, 1.1), Failure);
    EXPECT_THROW(disc(1, 0.6), Failure);
}

}  // namespace
}  // namespace corpuscle::geometry
