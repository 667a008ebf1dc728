#include "membrane/diagnostics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "membrane/surface.hpp"

namespace corpuscle::membrane {

namespace {

double stretchOf(const Bond& bond, std::span<const Vec3> x) {
    return (x[bond.node[1]] - x[bond.node[0]]).norm() / bond.rest;
}

// A triangle in its plane, with the edge from corner 0 to 1 along the first axis, and the tension in this plane times
// the area.
struct InPlane {
    Eigen::Vector2d a, b;  // edges from corner 0 to 1 and to 2, m
    double xx = 0, xy = 0, yy = 0;

    InPlane(const Vec3& edgeA, const Vec3& edgeB, double area) {
        const double length = edgeA.norm();
        a = {length, 0};
        b = {edgeA.dot(edgeB) / length, 2 * area / length};
    }
    void add(double factor, const Eigen::Vector2d& u, const Eigen::Vector2d& v) {  // the symmetric part of u v^T
        xx += factor * u[0] * v[0];
        yy += factor * u[1] * v[1];
        xy += 0.5 * factor * (u[0] * v[1] + u[1] * v[0]);
    }
};

void addBonds(const Network& network, const BondLaw& law, int triangle, InPlane& plane) {
    const std::array<Eigen::Vector2d, 3> edges{plane.a, plane.b - plane.a, plane.b};
    for (int k = 0; k < 3; ++k) {
        const Bond& bond = network.allBonds()[network.triangleBonds(triangle)[k]];
        const double l = edges[k].norm();
        const double tension = law.tension(l, bond.rest), share = tension > 0 ? network.shareOfBond(bond.number) : 1;
        plane.add(0.5 * share * law.weight(network, bond) * tension / l, edges[k], edges[k]);
    }
}

void addSheet(const Network& network, const TriangleLaw& law, int triangle, InPlane& plane) {
    const RestTriangle rest(network.stressFree(), network.triangles()[triangle]);
    const Vec3 products(plane.a.squaredNorm(), plane.a.dot(plane.b), plane.b.squaredNorm());
    const Vec3 t = network.shareOfTriangle(triangle) * rest.area * rest.pullBack(law.slope(rest.strain(products)));
    plane.add(2 * t[0], plane.a, plane.a);
    plane.add(2 * t[1], plane.a, plane.b);
    plane.add(2 * t[2], plane.b, plane.b);
}

}  // namespace

double arealStrain(const Network& network, int triangle, std::span<const Vec3> x) {
    return areaVector(x, network.triangles()[triangle]).norm() / network.restAreas()[triangle] - 1;
}

std::pair<double, double> principalTensions(const Network& network, const MembraneSettings& laws, int triangle,
                                            std::span<const Vec3> x) {
    const Index3& corner = network.triangles()[triangle];
    const double area = areaVector(x, corner).norm();
    if (area == 0) {
        return {0, 0};
    }
    InPlane plane(x[corner[1]] - x[corner[0]], x[corner[2]] - x[corner[0]], area);
    if (laws.bonds) {
        addBonds(network, *laws.bonds, triangle, plane);
    }
    if (laws.triangles) {
        addSheet(network, *laws.triangles, triangle, plane);
    }
    const double mean = 0.5 * (plane.xx + plane.yy), radius = std::hypot(0.5 * (plane.xx - plane.yy), plane.xy);
    return {(mean + radius) / area, (mean - radius) / area};
}

std::vector<double> areaStrain(const Network& network, std::span<const Vec3> x) {
    std::vector<double> strain(network.triangles().size(), 0.0);
    for (const int t : network.wholeTriangles()) {
        strain[t] = arealStrain(network, t, x);
    }
    return strain;
}

PrincipalTensions principalTensions(const Network& network, const MembraneSettings& laws, std::span<const Vec3> x) {
    PrincipalTensions result;
    result.tension1.assign(network.triangles().size(), 0.0);
    result.tension2 = result.tension1;
    for (const int t : network.wholeTriangles()) {
        std::tie(result.tension1[t], result.tension2[t]) = principalTensions(network, laws, t, x);
    }
    return result;
}

std::vector<double> isotropicTensions(const Network& network, const MembraneSettings& laws, std::span<const Vec3> x) {
    std::vector<double> tension(network.triangles().size(), 0.0);
    const AreaConstraint area = laws.area.value_or(AreaConstraint{});
    double stressFree = 0, present = 0;
    for (const double A0 : network.restAreas()) stressFree += A0;
    const double target = area.restArea(network), scale = target / stressFree;
    for (const int t : network.wholeTriangles()) {
        const auto [tension1, tension2] = principalTensions(network, laws, t, x);
        const double A = areaVector(x, network.triangles()[t]).norm(), A0 = scale * network.restAreas()[t];
        const double share = A > A0 ? network.shareOfTriangle(t) : 1;
        tension[t] = 0.5 * (tension1 + tension2) + share * area.local.value_or(0) * (A / A0 - 1);
        present += A;
    }
    if (!area.global || network.wasOpen()) return tension;
    for (const int t : network.wholeTriangles()) tension[t] += *area.global * (present / target - 1);
    return tension;
}

std::vector<double> nodeStretch(const Network& network, std::span<const Vec3> x) {
    std::vector<double> stretch(network.nodeCount(), 0.0);
    std::vector<int> count(network.nodeCount(), 0);
    for (const Bond& bond : network.bonds()) {
        for (const int node : bond.node) {
            stretch[node] += stretchOf(bond, x);
            ++count[node];
        }
    }
    for (std::size_t n = 0; n < stretch.size(); ++n) {
        stretch[n] /= std::max(count[n], 1);
    }
    return stretch;
}

std::vector<double> vertexAreas(const Network& network, std::span<const Vec3> x) {
    std::vector<double> areas(x.size(), 0.0);
    for (const int t : network.wholeTriangles()) {
        const Index3& corner = network.triangles()[t];
        const double third = areaVector(x, corner).norm() / 3;
        for (const int node : corner) {
            areas[node] += third;
        }
    }
    return areas;
}

std::vector<std::int64_t> holeOfNodes(const Network& network) {
    std::vector<std::int64_t> hole(network.nodeCount(), 0);
    std::int64_t number = 0;
    for (const std::vector<int>& rim : network.rims()) {
        ++number;
        for (const int node : rim) {
            hole[node] = number;
        }
    }
    return hole;
}

std::vector<double> heldPressures(const Network& network, std::span<const Vec3> x, std::span<const Vec3> force) {
    std::vector<Vec3> areas(network.nodeCount(), Vec3::Zero());
    for (const int t : network.wholeTriangles()) {
        const Index3& corner = network.triangles()[t];
        for (const int n : corner) areas[n] += areaVector(x, corner) / 3;
    }
    std::vector<double> normal(areas.size()), area(areas.size());
    for (std::size_t n = 0; n < areas.size(); ++n) {
        area[n] = areas[n].norm();
        normal[n] = area[n] > 0 ? -force[n].dot(areas[n]) / area[n] : 0;
    }
    std::vector<double> pressure = normal, around = area;
    for (const Bond& bond : network.bonds()) {
        const auto [a, b] = bond.node;
        pressure[a] += normal[b], pressure[b] += normal[a];
        around[a] += area[b], around[b] += area[a];
    }
    for (std::size_t n = 0; n < areas.size(); ++n) pressure[n] = around[n] > 0 ? pressure[n] / around[n] : 0;
    return pressure;
}

double maxBondStrain(const Network& network, std::span<const Vec3> x) {
    double largest = network.bonds().empty() ? 1 : 0;
    for (const Bond& bond : network.bonds()) {
        largest = std::max(largest, stretchOf(bond, x));
    }
    return largest - 1;
}

double maxArealStrain(const Network& network, std::span<const Vec3> x) {
    double largest = network.wholeTriangles().empty() ? 0 : -1;
    for (const int t : network.wholeTriangles()) {
        largest = std::max(largest, arealStrain(network, t, x));
    }
    return largest;
}

double maxTension(const Network& network, const MembraneSettings& laws, std::span<const Vec3> x) {
    double largest = network.wholeTriangles().empty() ? 0 : -std::numeric_limits<double>::infinity();
    for (const int t : network.wholeTriangles()) {
        largest = std::max(largest, principalTensions(network, laws, t, x).first);
    }
    return largest;
}

}  // namespace corpuscle::membrane
