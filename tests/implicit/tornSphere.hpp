// A spherical membrane with a round hole in a periodic box of fluid. Lengths in spacings, density and viscosity 1.
#pragma once
#include <cmath>
#include <numeric>

#include "coupling/fluidScene.hpp"
#include "coupling/sphereScene.hpp"
#include "membrane/surface.hpp"

namespace corpuscle::implicit::testing {

inline constexpr double holeOverSphere = 0.4;  // a/R

inline sph::FluidModel fluid(double soundSpeed) {
    sph::FluidModel m = sph::testing::model("wendlandC2", "linear");
    m.viscosity = 1, m.soundSpeed = soundSpeed;
    return m;
}

// Of the sphere in a cubic box.
inline Vec3 middleOf(int length) { return Vec3::Constant(0.5 * length) + Vec3(0.13, -0.21, 0.07); }

inline double dot(const std::vector<Vec3>& v, const std::vector<Vec3>& w) {
    return std::inner_product(v.begin(), v.end(), w.begin(), 0.0, std::plus<>(),
                              [](const Vec3& x, const Vec3& y) { return x.dot(y); });
}

// Nodes on the unit sphere; the triangles around +x within the angle of the hole are to be removed.
struct TornSphere {
    membrane::testing::Mesh mesh;
    std::vector<char> alive;  // of the bonds: 0 where a triangle of the hole meets another one

    explicit TornSphere(int level) : mesh(membrane::testing::icosphere(level)) {
        const double angle = std::asin(holeOverSphere);
        const auto isInHole = [&](const Index3& t) {
            const Vec3 middle = (mesh.nodes[t[0]] + mesh.nodes[t[1]] + mesh.nodes[t[2]]).normalized();
            return std::acos(middle[0]) < angle;
        };
        membrane::Network network(mesh.nodes, mesh.triangles);
        std::vector<int> cut;
        for (const membrane::Bond& bond : network.allBonds()) {
            const auto [left, right] = network.bondTriangles(bond.number);
            if (isInHole(mesh.triangles[left]) && isInHole(mesh.triangles[right])) cut.push_back(bond.number);
        }
        network.breakBonds(cut);
        alive = network.aliveBonds();
        for (const std::vector<int>& rim : network.rims())  // onto the circle
            for (const int node : rim) {
                const Vec3 across = Vec3(0, mesh.nodes[node][1], mesh.nodes[node][2]).normalized();
                mesh.nodes[node] = std::cos(angle) * Vec3::UnitX() + std::sin(angle) * across;
            }
    }
};

// The surface of a torn cell, closed by fans over its rims.
inline geometry::TriangleMesh closedSurface(const membrane::Membrane& m) {
    geometry::TriangleMesh mesh{m.position, {}};
    for (const int t : m.network().wholeTriangles()) mesh.triangles.push_back(m.network().triangles()[t]);
    for (const std::vector<int>& rim : m.network().rims()) {
        const int middle = static_cast<int>(mesh.nodes.size());
        mesh.nodes.push_back(membrane::meanPoint(m.position, rim));
        for (std::size_t k = 0; k < rim.size(); ++k)
            mesh.triangles.push_back({middle, rim[(k + 1) % rim.size()], rim[k]});
    }
    return mesh;
}

}  // namespace corpuscle::implicit::testing
