// Meshes and helper functions for the membrane tests. Lengths are of order 1, so that errors are relative ones.
#pragma once
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include "core/vec.hpp"

namespace corpuscle::membrane::testing {

struct Mesh {
    std::vector<Vec3> nodes;
    std::vector<Index3> triangles;
};

// Icosahedron on the unit sphere, each triangle split in four `level` times: 42, 162, 642 nodes.
inline Mesh icosphere(int level) {
    const double g = std::numbers::phi;
    Mesh mesh;
    mesh.nodes = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                  {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (Vec3& x : mesh.nodes) {
        x.normalize();
    }
    for (int pass = 0; pass < level; ++pass) {
        std::map<std::pair<int, int>, int> middles;
        const auto middle = [&](int a, int b) {
            const auto [place, isNew] = middles.try_emplace(std::minmax(a, b), static_cast<int>(mesh.nodes.size()));
            if (isNew) {
                mesh.nodes.push_back((mesh.nodes[a] + mesh.nodes[b]).normalized());
            }
            return place->second;
        };
        std::vector<Index3> finer;
        for (const auto [a, b, c] : mesh.triangles) {
            const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh.triangles = finer;
    }
    return mesh;
}

inline void jitter(std::vector<Vec3>& nodes, double amplitude, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shift(-amplitude, amplitude);
    for (Vec3& x : nodes) {
        x += Vec3(shift(random), shift(random), shift(random));
    }
}

// An ellipsoid with nodes displaced by up to a fifth of an edge: unequal edges and angles.
inline Mesh irregular(int level) {
    Mesh mesh = icosphere(level);
    const double edge = 1.1 / (1 << level);
    jitter(mesh.nodes, 0.2 * edge, 7);
    for (Vec3& x : mesh.nodes) {
        x = Vec3(1.3 * x.x(), x.y(), 0.6 * x.z());
    }
    return mesh;
}

// The nodes stretched 1.6 times, flattened, bent into the shape of a banana, and displaced at random.
inline std::vector<Vec3> deformed(const std::vector<Vec3>& nodes, double edge) {
    std::vector<Vec3> x;
    for (const Vec3& p : nodes) {
        x.emplace_back(1.6 * p.x(), 0.7 * p.y() + 0.3 * std::sin(2 * p.x()), 0.8 * p.z() + 0.4 * p.x() * p.x());
    }
    jitter(x, 0.15 * edge, 11);
    return x;
}

// Flat patch of a hexagonal lattice of edge 1 in x-y with n x n cells of two triangles.
inline Mesh hexagonalPatch(int n) {
    Mesh mesh;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            mesh.nodes.emplace_back(i + 0.5 * j, std::sqrt(0.75) * j, 0.0);
        }
    }
    const auto node = [n](int i, int j) { return j * (n + 1) + i; };
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            mesh.triangles.push_back({node(i, j), node(i + 1, j), node(i, j + 1)});
            mesh.triangles.push_back({node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
        }
    }
    return mesh;
}

inline constexpr double hexagonalCell = 0.8660254037844386;  // area of a cell of two triangles, edge 1

// A quantity of an n x n patch is a n^2 + b n + c, borders and corners included; half its second difference is a, the
// bulk value of one cell without any error from the border.
inline double bulk(const std::function<double(const Mesh&)>& ofPatch) {
    return 0.5 * (ofPatch(hexagonalPatch(6)) - 2 * ofPatch(hexagonalPatch(5)) + ofPatch(hexagonalPatch(4)));
}

}  // namespace corpuscle::membrane::testing
