#include "membrane/helfrichTerm.hpp"

#include <algorithm>

#include "membrane/hessian.hpp"

namespace corpuscle::membrane {

namespace {

std::array<int, 3> turned(const Index3& triangle, int k) {
    return {triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3]};
}

template <std::size_t N>
std::array<Vec3, N> places(std::span<const Vec3> x, const std::array<int, N>& node) {
    std::array<Vec3, N> corner;
    for (std::size_t k = 0; k < N; ++k) {
        corner[k] = x[node[k]];
    }
    return corner;
}

}  // namespace

struct HelfrichTerm::State {
    std::vector<Coordinate<4>> edges;                  // of each hinge
    std::vector<std::array<Coordinate<3>, 3>> shares;  // of each whole triangle, by corner
    std::vector<double> area;                          // A_v
    std::vector<double> curvature;                     // C_v
    std::vector<double> byM, byA;                      // dE/dM_v, dE/dA_v
    std::vector<char> counts;                          // whether the node has its complete ring
    double energy = 0;
    bool hasDifference = false;
};

struct HelfrichTerm::Ring {
    int centre;
    std::vector<int> hinges, triangles;  // of the node, as indices in the lists of living elements
    std::vector<int> nodes;              // centre first
    Eigen::VectorXd w;                   // three rows for each node

    Eigen::Index place(int node) const { return 3 * (std::find(nodes.begin(), nodes.end(), node) - nodes.begin()); }
};

HelfrichTerm::HelfrichTerm(const Network& network, const HelfrichModuli& moduli)
    : network_(network), moduli_(moduli), valence_(network.nodeCount(), 0) {
    for (const Bond& bond : network.allBonds()) {
        for (const int node : bond.node) {
            ++valence_[node];
        }
    }
}

HelfrichTerm::State HelfrichTerm::evaluate(std::span<const Vec3> x) const {
    State s;
    const std::size_t count = x.size();
    const auto& hinges = network_.hinges();
    const auto& triangles = network_.wholeTriangles();
    std::vector<double> integral(count, 0.0);  // M_v
    std::vector<int> found(count, 0);
    s.edges.reserve(hinges.size());
    for (const Hinge& hinge : hinges) {
        s.edges.push_back(EdgeCurvature::at(places(x, hinge.node)));
        for (int k = 0; k < 2; ++k) {
            integral[hinge.node[k]] += 0.25 * s.edges.back().value;
            ++found[hinge.node[k]];
        }
    }
    s.area.assign(count, 0.0);
    s.shares.reserve(triangles.size());
    for (const int t : triangles) {
        const Index3& node = network_.triangles()[t];
        s.shares.push_back(nodeAreas<3, double>(places(x, node)));
        for (int k = 0; k < 3; ++k) {
            s.area[node[k]] += s.shares.back()[k].value;
        }
    }
    const auto& [kappa, c0, difference, restCurvature] = moduli_;
    s.curvature.assign(count, 0.0);
    s.byM = s.byA = s.curvature;
    s.counts.assign(count, 0);
    double total = 0;
    for (std::size_t v = 0; v < count; ++v) {
        s.counts[v] = found[v] > 0 && found[v] == valence_[v] && s.area[v] > 0;
        if (s.counts[v]) {
            const double c = s.curvature[v] = 2 * integral[v] / s.area[v];
            s.energy += 0.5 * kappa * (c - c0) * (c - c0) * s.area[v];
            s.byM[v] = 2 * kappa * (c - c0);
            s.byA[v] = 0.5 * kappa * (c0 * c0 - c * c);
        }
        total += integral[v];
    }
    s.hasDifference = difference != 0 && !network_.isOpen();
    if (s.hasDifference) {
        s.energy += 0.5 * difference * (total - restCurvature) * (total - restCurvature);
        for (double& slope : s.byM) {
            slope += difference * (total - restCurvature);
        }
    }
    return s;
}

double HelfrichTerm::energy(std::span<const Vec3> x) const { return evaluate(x).energy; }

void HelfrichTerm::addForces(std::span<const Vec3> x, std::span<Vec3> f) const {
    const State s = evaluate(x);
    const auto& hinges = network_.hinges();
    for (std::size_t h = 0; h < hinges.size(); ++h) {
        const auto& node = hinges[h].node;
        const double slope = 0.25 * (s.byM[node[0]] + s.byM[node[1]]);
        for (int k = 0; k < 4; ++k) {
            f[node[k]] -= slope * s.edges[h].gradient[k];
        }
    }
    const auto& triangles = network_.wholeTriangles();
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const Index3& node = network_.triangles()[triangles[t]];
        for (int m = 0; m < 3; ++m) {
            for (int k = 0; k < 3; ++k) {
                f[node[m]] -= s.byA[node[k]] * s.shares[t][k].gradient[m];
            }
        }
    }
}

std::vector<HelfrichTerm::Ring> HelfrichTerm::rings(const State& s) const {
    const auto& hinges = network_.hinges();
    const auto& whole = network_.wholeTriangles();
    std::vector<Ring> all(s.counts.size());
    for (int h = 0; h < static_cast<int>(hinges.size()); ++h) {
        for (int k = 0; k < 2; ++k) {
            all[hinges[h].node[k]].hinges.push_back(h);
        }
    }
    for (int t = 0; t < static_cast<int>(whole.size()); ++t) {
        for (const int node : network_.triangles()[whole[t]]) {
            all[node].triangles.push_back(t);
        }
    }
    std::vector<Ring> result;
    for (std::size_t v = 0; v < all.size(); ++v) {
        if (!s.counts[v]) {
            continue;
        }
        Ring& ring = all[v];
        ring.centre = static_cast<int>(v);
        ring.nodes = {ring.centre};
        for (const int h : ring.hinges) {
            const auto& node = hinges[h].node;
            ring.nodes.push_back(node[0] == ring.centre ? node[1] : node[0]);
        }
        ring.w = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(ring.nodes.size()));
        for (const int h : ring.hinges) {
            for (int k = 0; k < 4; ++k) {
                ring.w.segment<3>(ring.place(hinges[h].node[k])) += 0.25 * s.edges[h].gradient[k];
            }
        }
        for (const int t : ring.triangles) {
            const Index3& corner = network_.triangles()[whole[t]];
            const auto own = std::find(corner.begin(), corner.end(), ring.centre) - corner.begin();
            for (int m = 0; m < 3; ++m) {
                ring.w.segment<3>(ring.place(corner[m])) -= 0.5 * s.curvature[v] * s.shares[t][own].gradient[m];
            }
        }
        result.push_back(std::move(ring));
    }
    return result;
}

std::vector<Vec3> HelfrichTerm::gradientOfIntegral(const State& s) const {
    std::vector<Vec3> gradient(s.area.size(), Vec3::Zero());
    const auto& hinges = network_.hinges();
    for (std::size_t h = 0; h < hinges.size(); ++h) {
        for (int k = 0; k < 4; ++k) {
            gradient[hinges[h].node[k]] += 0.5 * s.edges[h].gradient[k];
        }
    }
    return gradient;
}

void HelfrichTerm::addCurvature(std::span<const Vec3> x, const State& s, const Ring& ring,
                                Eigen::MatrixXd& matrix) const {
    const int v = ring.centre;
    const auto scatter = [&](const auto& node, const auto& part, double factor) {
        for (std::size_t j = 0; j < node.size(); ++j) {
            for (std::size_t i = 0; i < node.size(); ++i) {
                matrix.block<3, 3>(ring.place(node[i]), ring.place(node[j])) +=
                    factor *
                    part.template block<3, 3>(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(3 * j));
            }
        }
    };
    for (const int h : ring.hinges) {
        const auto& node = network_.hinges()[h].node;
        scatter(node, hessian<EdgeCurvature>(places(x, node)), 0.25 * s.byM[v]);
    }
    for (const int t : ring.triangles) {
        const Index3& corner = network_.triangles()[network_.wholeTriangles()[t]];
        const auto first = static_cast<int>(std::find(corner.begin(), corner.end(), v) - corner.begin());
        const auto node = turned(corner, first);
        scatter(node, hessian<NodeArea>(places(x, node)), s.byA[v]);
    }
}

void HelfrichTerm::addStiffness(std::span<const Vec3> x, Definiteness definiteness, Stiffness& stiffness) const {
    const State s = evaluate(x);
    for (const Ring& ring : rings(s)) {
        const int v = ring.centre;
        Eigen::MatrixXd matrix = 4 * moduli_.kappa / s.area[v] * ring.w * ring.w.transpose();
        if (definiteness != Definiteness::partwise) {
            addCurvature(x, s, ring, matrix);
        }
        if (definiteness == Definiteness::semiDefinite) {
            matrix = semiDefinite(matrix);
        }
        stiffness.add(ring.nodes, matrix);
    }
    if (s.hasDifference) {
        stiffness.addRankOne(moduli_.difference, gradientOfIntegral(s));
    }
}

double HelfrichTerm::maxStiffness(std::span<const Vec3> x) const {
    const State s = evaluate(x);
    std::vector<double> ofNode(x.size(), 0.0);
    for (const Ring& ring : rings(s)) {
        double sum = 0;
        for (std::size_t n = 0; n < ring.nodes.size(); ++n) {
            sum += ring.w.segment<3>(3 * static_cast<Eigen::Index>(n)).norm();
        }
        for (std::size_t n = 0; n < ring.nodes.size(); ++n) {
            ofNode[ring.nodes[n]] += 4 * moduli_.kappa / s.area[ring.centre] * sum *
                                     ring.w.segment<3>(3 * static_cast<Eigen::Index>(n)).norm();
        }
    }
    double bound = ofNode.empty() ? 0.0 : *std::max_element(ofNode.begin(), ofNode.end());
    if (s.hasDifference) {
        for (const Vec3& g : gradientOfIntegral(s)) {
            bound += moduli_.difference * g.squaredNorm();
        }
    }
    return bound;
}

}  // namespace corpuscle::membrane
