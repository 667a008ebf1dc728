#include "membrane/diagnostics.hpp"

#include <algorithm>
#include <cmath>

#include "membrane/surface.hpp"

namespace corpuscle::membrane {

namespace {

double stretchOf(const Bond& bond, std::span<const Vec3> x) {
    return (x[bond.node[1]] - x[bond.node[0]]).norm() / bond.rest;
}

}  // namespace

std::vector<double> areaStrain(const Network& network, std::span<const Vec3> x) {
    std::vector<double> strain(network.triangles().size(), 0.0);
    for (const int t : network.wholeTriangles()) {
        strain[t] = areaVector(x, network.triangles()[t]).norm() / network.restAreas()[t] - 1;
    }
    return strain;
}

PrincipalTensions principalTensions(const Network& network, const BondLaw& law, std::span<const Vec3> x) {
    PrincipalTensions result;
    result.tension1.assign(network.triangles().size(), 0.0);
    result.tension2 = result.tension1;
    for (const int t : network.wholeTriangles()) {
        const Index3& corner = network.triangles()[t];
        const Vec3 normal = areaVector(x, corner);
        const double area = normal.norm();
        if (area == 0) {
            continue;
        }
        const Vec3 e1 = (x[corner[1]] - x[corner[0]]).normalized(), e2 = normal.cross(e1) / area;
        double xx = 0, yy = 0, xy = 0;
        for (const int number : network.triangleBonds(t)) {
            const Bond& bond = network.allBonds()[number];
            const Vec3 r = x[bond.node[1]] - x[bond.node[0]];
            const double l = r.norm(), share = 0.5 * law.tension(l, bond.rest) / (l * area);
            const double r1 = r.dot(e1), r2 = r.dot(e2);
            xx += share * r1 * r1;
            yy += share * r2 * r2;
            xy += share * r1 * r2;
        }
        const double mean = 0.5 * (xx + yy), radius = std::hypot(0.5 * (xx - yy), xy);
        result.tension1[t] = mean + radius;
        result.tension2[t] = mean - radius;
    }
    return result;
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

double maxBondStrain(const Network& network, std::span<const Vec3> x) {
    double largest = network.bonds().empty() ? 1 : 0;
    for (const Bond& bond : network.bonds()) {
        largest = std::max(largest, stretchOf(bond, x));
    }
    return largest - 1;
}

}  // namespace corpuscle::membrane
