#include <algorithm>
#include <cmath>

#include "geometry/surfaceAlgorithms.hpp"

namespace corpuscle::geometry {
namespace {

TriangleMesh icosahedron() {
    const double g = (1 + std::sqrt(5.0)) / 2;
    TriangleMesh mesh;
    mesh.nodes = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                  {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (Vec3& x : mesh.nodes) x.normalize();
    return mesh;
}

}  // namespace

TriangleMesh starSurface(const std::function<double(const Vec3&)>& F, const Vec3& half, int refinements) {
    TriangleMesh mesh = icosahedron();
    for (int n = 0; n < refinements; ++n) mesh = refineOnce(mesh, [](const Vec3& x) { return x.normalized(); });
    for (Vec3& x : mesh.nodes) {
        const Vec3 ray = x.cwiseProduct(half);
        double inside = 0, outside = 2;  // half is the half size of the bounding box: the surface lies below 2
        for (int bisection = 0; bisection < 40; ++bisection) {
            const double middle = (inside + outside) / 2;
            (F(middle * ray) < 0 ? inside : outside) = middle;
        }
        x = (inside + outside) / 2 * ray;
    }
    return mesh;
}

}  // namespace corpuscle::geometry
