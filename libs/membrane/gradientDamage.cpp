#include "membrane/gradientDamage.hpp"

#include <algorithm>
#include <cmath>

#include "membrane/surface.hpp"

namespace corpuscle::membrane {

namespace {

// sqrt(sqrt(3) A0): height of an equilateral triangle of the same area.
double rowHeight(const Network& network, std::size_t triangle) {
    return std::sqrt(std::sqrt(3.0) * network.restAreas()[triangle]);
}

// Weight of each edge in the integral of Gg |grad d|^2: sum over its triangles of Gg cot(a)/2, with the angle opposite
// the edge, over G; at least 0.
std::vector<double> edgeWeights(const Network& network, double length) {
    constexpr double least = 0.25;  // on a mesh that does not resolve the length
    std::vector<double> weights(network.allBonds().size(), 0.0);
    const std::vector<Vec3>& x = network.stressFree();
    for (std::size_t t = 0; t < network.triangles().size(); ++t) {
        const Index3& node = network.triangles()[t];
        const Index3& bonds = network.triangleBonds(static_cast<int>(t));
        const double sides = std::max(1 - 3 * rowHeight(network, t) / (8 * length), least);
        for (int k = 0; k < 3; ++k) {
            const Vec3 &apex = x[node[(k + 2) % 3]], u = x[node[k]] - apex, v = x[node[(k + 1) % 3]] - apex;
            weights[bonds[k]] += 0.5 * sides * sides * u.dot(v) / u.cross(v).norm();
        }
    }
    for (double& w : weights) w = std::max(w, 0.0);
    return weights;
}

std::vector<double> restNodeAreas(const Network& network) {
    std::vector<double> areas(network.nodeCount(), 0.0);
    for (std::size_t t = 0; t < network.triangles().size(); ++t)
        for (const int node : network.triangles()[t]) areas[node] += network.restAreas()[t] / 3;
    return areas;
}

// Neighbours of each node along edges, with the weights of the edges.
struct Neighbours {
    struct Link {
        int node;
        double weight;
    };
    std::vector<int> first;
    std::vector<Link> links;

    Neighbours(const Network& network, const std::vector<double>& weights)
        : first(network.nodeCount() + 1, 0), links(0) {
        for (const Bond& bond : network.allBonds())
            for (const int node : bond.node) ++first[node + 1];
        for (std::size_t n = 1; n < first.size(); ++n) first[n] += first[n - 1];
        links.resize(static_cast<std::size_t>(first.back()));
        std::vector<int> next(first.begin(), first.end() - 1);
        for (const Bond& bond : network.allBonds()) {
            const auto [a, b] = bond.node;
            links[next[a]++] = {b, weights[bond.number]};
            links[next[b]++] = {a, weights[bond.number]};
        }
    }
    std::span<const Link> of(std::size_t node) const {
        return {links.data() + first[node], static_cast<std::size_t>(first[node + 1] - first[node])};
    }
};

}  // namespace

GradientDamage::GradientDamage(const Network& network, double fractureEnergy, double length)
    : network_(network),
      length_(length),
      onset_(3 * fractureEnergy / (16 * length)),
      gradient_(3.0 / 8 * fractureEnergy * length) {}

void GradientDamage::grow(std::span<const double> tensileEnergy, std::span<double> damage) const {
    // Derivative of the energy by d of a node: -2 (1 - d) source + local + 2 gradient (sum of w (d - d of neighbour)).
    constexpr double mostOnsets = 1e4, precision = 1e-9, relaxation = 1.5;
    constexpr int mostSweeps = 10000;
    const std::vector<double> area = restNodeAreas(network_);
    std::vector<double> source(damage.size(), 0.0);
    for (std::size_t t = 0; t < tensileEnergy.size(); ++t) {
        const double energy = std::min(tensileEnergy[t], mostOnsets * onset_ * network_.restAreas()[t]);
        for (const int node : network_.triangles()[t]) source[node] += energy / 3;
    }
    bool isElastic = true;
    for (std::size_t n = 0; n < damage.size() && isElastic; ++n)
        isElastic = !(damage[n] > 0) && !(source[n] > onset_ * area[n]);
    if (isElastic) return;
    const Neighbours neighbours(network_, edgeWeights(network_, length_));
    const std::vector<double> least(damage.begin(), damage.end());
    double change = 1;
    for (int sweep = 0; sweep < mostSweeps && change > precision; ++sweep) {
        change = 0;
        for (std::size_t n = 0; n < damage.size(); ++n) {
            double sum = 2 * source[n] - 2 * onset_ * area[n], diagonal = 2 * source[n];
            for (const Neighbours::Link& link : neighbours.of(n)) {
                sum += 2 * gradient_ * link.weight * damage[link.node];
                diagonal += 2 * gradient_ * link.weight;
            }
            if (!(diagonal > 0)) continue;
            const double found =
                std::clamp(damage[n] + relaxation * (sum / diagonal - damage[n]), std::min(least[n], 1.0), 1.0);
            change = std::max(change, std::abs(found - damage[n]));
            damage[n] = found;
        }
    }
}

double GradientDamage::surfaceEnergy(std::span<const double> damage) const {
    const std::vector<double> area = restNodeAreas(network_), weights = edgeWeights(network_, length_);
    double sum = 0;
    for (std::size_t n = 0; n < damage.size(); ++n) sum += 2 * onset_ * area[n] * damage[n];
    for (const Bond& bond : network_.allBonds()) {
        const double jump = damage[bond.node[0]] - damage[bond.node[1]];
        sum += gradient_ * weights[bond.number] * jump * jump;
    }
    return sum;
}

std::vector<double> keptShares(const Network& network, std::span<const double> damage) {
    std::vector<double> shares;
    shares.reserve(network.triangles().size());
    for (const Index3& node : network.triangles()) {
        double sum = 0;
        for (const int n : node) sum += (1 - damage[n]) * (1 - damage[n]);
        shares.push_back(sum / 3);
    }
    return shares;
}

}  // namespace corpuscle::membrane
