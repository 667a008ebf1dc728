// Meshes and random numbers for the tests of contact.
#pragma once
#include <random>

#include "contact/surface.hpp"
#include "geometry/triangleMesh.hpp"

namespace corpuscle::contact {

class Random {
  public:
    explicit Random(unsigned long seed) : engine_(seed) {}
    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
    Vec3 vector(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }

  private:
    std::mt19937_64 engine_;
};

// An icosphere: an icosahedron whose triangles are split into four `levels` times, with all nodes on the sphere; 20 x
// 4^levels triangles.
inline geometry::TriangleMesh sphere(double radius, int levels) {
    const double g = 0.5 * (1 + std::sqrt(5.0));
    geometry::TriangleMesh mesh;
    mesh.nodes = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                  {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (int level = 0; level < levels; ++level) {
        const Surface pieces(mesh.nodes, mesh.triangles);
        const int first = static_cast<int>(mesh.nodes.size());
        for (const Edge& e : pieces.edges()) mesh.nodes.push_back(0.5 * (mesh.nodes[e[0]] + mesh.nodes[e[1]]));
        std::vector<Index3> finer;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const Index3 &c = mesh.triangles[t], &s = pieces.sides()[t];
            const int ab = first + s[0], bc = first + s[1], ca = first + s[2];
            for (const Index3& one :
                 {Index3{c[0], ab, ca}, Index3{c[1], bc, ab}, Index3{c[2], ca, bc}, Index3{ab, bc, ca}})
                finer.push_back(one);
        }
        mesh.triangles = finer;
    }
    for (Vec3& x : mesh.nodes) x *= radius / x.norm();
    return mesh;
}

// Several meshes, their nodes numbered consecutively.
struct Scene {
    std::vector<Surface> surfaces;
    std::vector<Vec3> x;

    void add(const geometry::TriangleMesh& mesh) {
        surfaces.emplace_back(mesh.nodes, mesh.triangles);
        x.insert(x.end(), mesh.nodes.begin(), mesh.nodes.end());
    }
    std::vector<const Surface*> pointers() const {
        std::vector<const Surface*> all;
        for (const Surface& one : surfaces) all.push_back(&one);
        return all;
    }
};

}  // namespace corpuscle::contact
