#include "membrane/diagnostics.hpp"

#include <algorithm>
#include <cmath>

#include "membrane/surface.hpp"

namespace corpuscle::membrane {

namespace {

double stretchOf(const Bond& bond, std::span<const Vec3> x) {
    return (x[bond.node[1]] - x[bond.node[0]]).norm() / bond.rest;
}

void addBonds(const Network& network, const BondLaw& law, int triangle, std::span<const Vec3> x, Mat3& virial) {
    for (const int number : network.triangleBonds(triangle)) {
        const Bond& bond = network.allBonds()[number];
        const Vec3 r = x[bond.node[1]] - x[bond.node[0]];
        const double l = r.norm();
        virial += 0.5 * law.weight(network, bond) * law.tension(l, bond.rest) / l * r * r.transpose();
    }
}

void addSheet(const Network& network, const TriangleLaw& law, int triangle, std::span<const Vec3> x, Mat3& virial) {
    const RestTriangle rest(network.stressFree(), network.triangles()[triangle]);
    const Vec3 a = x[rest.node[1]] - x[rest.node[0]], b = x[rest.node[2]] - x[rest.node[0]];
    const Vec3 t = rest.area * rest.pullBack(law.slope(rest.strain(edgeProducts(a, b))));
    virial += 2 * t[0] * a * a.transpose() + 2 * t[2] * b * b.transpose();
    virial += t[1] * (a * b.transpose() + b * a.transpose());
}

}  // namespace

std::vector<double> areaStrain(const Network& network, std::span<const Vec3> x) {
    std::vector<double> strain(network.triangles().size(), 0.0);
    for (const int t : network.wholeTriangles()) {
        strain[t] = areaVector(x, network.triangles()[t]).norm() / network.restAreas()[t] - 1;
    }
    return strain;
}

PrincipalTensions principalTensions(const Network& network, const MembraneSettings& laws, std::span<const Vec3> x) {
    PrincipalTensions result;
    result.tension1.assign(network.triangles().size(), 0.0);
    result.tension2 = result.tension1;
    for (const int t : network.wholeTriangles()) {
        const double area = areaVector(x, network.triangles()[t]).norm();
        if (area == 0) {
            continue;
        }
        Mat3 virial = Mat3::Zero();  // area times tension
        if (laws.bonds) {
            addBonds(network, *laws.bonds, t, x, virial);
        }
        if (laws.triangles) {
            addSheet(network, *laws.triangles, t, x, virial);
        }
        const Index3& corner = network.triangles()[t];
        const Vec3 normal = areaVector(x, corner) / area, e1 = (x[corner[1]] - x[corner[0]]).normalized();
        const Vec3 e2 = normal.cross(e1);
        const double xx = e1.dot(virial * e1) / area, yy = e2.dot(virial * e2) / area, xy = e1.dot(virial * e2) / area;
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

double maxBondStrain(const Network& network, std::span<const Vec3> x) {
    double largest = network.bonds().empty() ? 1 : 0;
    for (const Bond& bond : network.bonds()) {
        largest = std::max(largest, stretchOf(bond, x));
    }
    return largest - 1;
}

}  // namespace corpuscle::membrane
