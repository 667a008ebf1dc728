#include "membrane/curvature.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "membrane/meshes.hpp"

using namespace corpuscle;
using namespace corpuscle::membrane;

namespace {

double difference(std::span<const Vec3> x, std::span<const Index3> triangles, const Vec3& direction, std::size_t node) {
    const auto area = [&](double h) {
        std::vector<Vec3> moved(x.begin(), x.end());
        moved[node] += h * direction;
        double sum = 0;
        for (const Index3& t : triangles) sum += areaVector(moved, t).norm();
        return sum;
    };
    constexpr double h = 1e-5;
    return (area(h) - area(-h)) / (2 * h);
}

}  // namespace

TEST(Curvature, areaGradientIsTheDerivativeOfTheArea) {
    auto mesh = membrane::testing::icosphere(1);
    for (std::size_t m = 0; m < mesh.nodes.size(); ++m)
        mesh.nodes[m] *= 1 + 0.1 * std::sin(5.0 * static_cast<double>(m));
    const auto gradient = areaGradient(mesh.nodes, mesh.triangles);
    for (const std::size_t node : {0u, 7u, 20u})
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(gradient[node][k], difference(mesh.nodes, mesh.triangles, Vec3::Unit(k), node), 1e-8);
}

// Sum of the principal curvatures of the spheroid x^2 + y^2 + (z/c)^2 = 1: h^3 (2 + c^2 - r^2)/c^2 with h = (x^2 + y^2
// + z^2/c^4)^(-1/2), and r the distance from the centre. Single nodes whose triangles differ in size have errors of up
// to 15 %, means over bands do not.
TEST(Curvature, ofASpheroidIsThatOfTheFormula) {
    constexpr std::size_t bands = 5;
    for (const double c : {1.0, 0.4, 2.0}) {
        auto mesh = membrane::testing::icosphere(5);
        for (Vec3& x : mesh.nodes) x[2] *= c;
        const auto k = curvatures(mesh.nodes, mesh.triangles);
        const auto area = volumeGradient(mesh.nodes, mesh.triangles);
        std::array<double, bands> found{}, expected{};
        for (std::size_t m = 0; m < k.size(); ++m) {
            const Vec3& x = mesh.nodes[m];
            const double h = 1 / Vec3(x[0], x[1], x[2] / (c * c)).norm();
            const auto band = std::min(static_cast<std::size_t>(bands * std::abs(x[2]) / c), bands - 1);
            found[band] += k[m] * area[m].norm();
            expected[band] += h * h * h * (2 + c * c - x.squaredNorm()) / (c * c) * area[m].norm();
        }
        for (std::size_t band = 0; band < bands; ++band)
            EXPECT_NEAR(found[band] / expected[band], 1, 0.02) << "c " << c << ", band " << band;
        for (Index3& t : mesh.triangles) std::swap(t[0], t[1]);
        EXPECT_NEAR(curvatures(mesh.nodes, mesh.triangles)[3], -k[3], 1e-12);
    }
}
