// The loop over elements, written once for every law of one internal coordinate q with rest value q0:
//
//     E = sum over elements of w E(q, q0),   F_n = -w E'(q, q0) dq/dx_n
//
// with a weight w for each element, which is 1 unless the law provides weights. Where the sheet is weakened
// (network.hpp), an element keeps the share s of its energy: E(q0) + s (E(q) - E(q0)) in place of E(q).
// Law: double energy(q, q0), derivative(q, q0), secondDerivative(q, q0).   Coordinate: coordinates.hpp.
// Stiffness of an element: E'' (dq/dx)(dq/dx)^T + E' d2q/dx2. Without the second, geometric part, its only non-zero
// eigenvalue is E'' |dq/dx|^2. The largest eigenvalue of the whole stiffness is at most the largest sum of these
// eigenvalues over the elements of a node.
#pragma once
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "membrane/coordinates.hpp"
#include "membrane/hessian.hpp"
#include "membrane/network.hpp"
#include "membrane/term.hpp"

namespace corpuscle::membrane {

inline const std::vector<Bond>& elementsOf(const Network& network, BondLength) { return network.bonds(); }
inline const std::vector<Corner>& elementsOf(const Network& network, CornerAngle) { return network.corners(); }
inline const std::vector<Hinge>& elementsOf(const Network& network, DihedralAngle) { return network.hinges(); }
inline const std::vector<Bond>& elementsOf(const Network& network, RimLength) { return network.rimBonds(); }

inline double shareOf(const Network& network, BondLength, int number) { return network.shareOfBond(number); }
inline double shareOf(const Network& network, CornerAngle, int number) { return network.shareOfTriangle(number); }

// All weights are 1; takes neither memory nor time.
struct Unweighted {
    static constexpr double of(int) { return 1; }
};
// One weight per element, by the element's number in the original network.
struct Weights {
    std::vector<double> values;
    double of(int number) const { return values[number]; }
};

template <class Coordinate, class Law, class Weighting = Unweighted>
class ElementTerm final : public Term {
  public:
    ElementTerm(const Network& network, Law law, Weighting weighting = {})
        : network_(network), law_(law), weighting_(std::move(weighting)) {}

    void addForces(std::span<const Vec3> x, std::span<Vec3> f) const override {
        for (const auto& element : elementsOf(network_, Coordinate{})) {
            const auto q = at(element, x);
            const double derivative = law_.derivative(q.value, element.rest),
                         slope = weighting_.of(element.number) * share(element.number, derivative) * derivative;
            for (int k = 0; k < Coordinate::nodes; ++k) {
                f[element.node[k]] -= slope * q.gradient[k];
            }
        }
    }

    double energy(std::span<const Vec3> x) const override {
        double sum = 0;
        for (const auto& element : elementsOf(network_, Coordinate{})) {
            const double q = at(element, x).value;
            double energy = law_.energy(q, element.rest);
            if (network_.isWeakened() && std::isfinite(energy)) {
                energy -= (1 - share(element.number, 1)) * tensile(q, element.rest);
            }
            sum += weighting_.of(element.number) * energy;
        }
        return sum;
    }

    void addTensileEnergy(std::span<const Vec3> x, std::span<double> ofTriangle) const override {
        if constexpr (Coordinate::weakening != Weakening::never) {
            for (const auto& element : elementsOf(network_, Coordinate{})) {
                const double q = at(element, x).value;
                const double energy = weighting_.of(element.number) * tensile(q, element.rest);
                if constexpr (Coordinate::weakening == Weakening::always) {
                    ofTriangle[element.number] += energy;
                } else {
                    const auto [left, right] = network_.bondTriangles(element.number);
                    const double part = left < 0 || right < 0 ? energy : 0.5 * energy;
                    if (left >= 0) ofTriangle[left] += part;
                    if (right >= 0) ofTriangle[right] += part;
                }
            }
        }
    }

    void addStiffness(std::span<const Vec3> x, Definiteness definiteness, Stiffness& stiffness) const override {
        constexpr int size = 3 * Coordinate::nodes;
        for (const auto& element : elementsOf(network_, Coordinate{})) {
            const auto corners = cornersOf(element, x);
            const auto q = Coordinate::at(corners);
            Eigen::Matrix<double, size, 1> gradient;
            for (int k = 0; k < Coordinate::nodes; ++k) {
                gradient.template segment<3>(3 * k) = q.gradient[k];
            }
            const double curvature = law_.secondDerivative(q.value, element.rest),
                         slope = law_.derivative(q.value, element.rest);
            Eigen::Matrix<double, size, size> matrix;
            if (definiteness == Definiteness::partwise) {
                matrix = std::max(curvature, 0.0) * gradient * gradient.transpose();
                Coordinate::addTension(q, slope, matrix);
            } else {
                matrix = curvature * gradient * gradient.transpose();
                matrix += slope * hessian<Coordinate>(corners);
            }
            matrix *= weighting_.of(element.number) * share(element.number, slope);
            if (definiteness == Definiteness::semiDefinite) {
                matrix = semiDefinite(matrix);
            }
            stiffness.add(element.node, matrix);
        }
    }

    double maxStiffness(std::span<const Vec3> x) const override {
        std::vector<double> ofNode(x.size(), 0.0);
        for (const auto& element : elementsOf(network_, Coordinate{})) {
            const auto q = at(element, x);
            double square = 0;
            for (const Vec3& g : q.gradient) {
                square += g.squaredNorm();
            }
            const double stiffness = weighting_.of(element.number) * law_.secondDerivative(q.value, element.rest);
            for (const int node : element.node) {
                ofNode[node] += std::max(0.0, stiffness) * square;
            }
        }
        return ofNode.empty() ? 0.0 : *std::max_element(ofNode.begin(), ofNode.end());
    }

  private:
    // Share of its energy that an element keeps. slope: E' without weight and share.
    double share(int number, double slope) const {
        if constexpr (Coordinate::weakening == Weakening::never) {
            return 1;
        } else {
            const bool weakens = network_.isWeakened() && (Coordinate::weakening == Weakening::always || slope > 0);
            return weakens ? shareOf(network_, Coordinate{}, number) : 1;
        }
    }
    // Energy of an element that tears it, without its weight.
    double tensile(double q, double rest) const {
        const double energy = law_.energy(q, rest);  // infinite where the derivative does not exist (contourBond.hpp)
        const bool counts =
            Coordinate::weakening == Weakening::always || !std::isfinite(energy) || law_.derivative(q, rest) > 0;
        return counts ? energy - law_.energy(rest, rest) : 0;
    }
    static auto cornersOf(const Element<Coordinate::nodes>& element, std::span<const Vec3> x) {
        std::array<Vec3, Coordinate::nodes> corner;
        for (int k = 0; k < Coordinate::nodes; ++k) {
            corner[k] = x[element.node[k]];
        }
        return corner;
    }
    static auto at(const Element<Coordinate::nodes>& element, std::span<const Vec3> x) {
        return Coordinate::at(cornersOf(element, x));
    }

    const Network& network_;
    Law law_;
    [[no_unique_address]] Weighting weighting_;
};

template <class Law, class Weighting = Unweighted>
using BondTerm = ElementTerm<BondLength, Law, Weighting>;
template <class Law>
using CornerTerm = ElementTerm<CornerAngle, Law>;
template <class Law>
using HingeTerm = ElementTerm<DihedralAngle, Law>;

}  // namespace corpuscle::membrane
