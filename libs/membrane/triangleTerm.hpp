// The loop over triangles of constant strain, written once for every law of the strain e (restTriangle.hpp):
//
//     E = sum over whole triangles of s A0 W(e),    t = dW/dg = L^T dW/de
//     F_1 = -A0 (2 t11 a + t12 b),   F_2 = -A0 (t12 a + 2 t22 b),   F_0 = -F_1 - F_2
//
// with the share s of its energy that a weakened triangle keeps (network.hpp), otherwise 1; t, F and the stiffness
// below are without s.
//
// Law: double energy(e) [J/m^2], Vec3 slope(e) = dW/de [N/m], Mat3 curvature(e) = d2W/de2 [N/m].
// Stiffness, in a and b: A0 (J^T L^T W'' L J + t11 2 aa + t12 ab + t22 2 bb), J = dg/d(a, b); the last three terms, the
// geometric part, are multiples of the unit matrix. The largest eigenvalue of the whole stiffness is at most the
// largest sum of the elements' largest eigenvalues over the elements of a node. Rest shapes are stored for all
// triangles of the original mesh; the loops run over the whole triangles only.
#pragma once
#include <Eigen/Eigenvalues>
#include <algorithm>

#include "membrane/network.hpp"
#include "membrane/restTriangle.hpp"
#include "membrane/term.hpp"

namespace corpuscle::membrane {

template <class Law>
class TriangleTerm final : public Term {
  public:
    TriangleTerm(const Network& network, Law law) : network_(network), law_(std::move(law)) {
        rest_.reserve(network.triangles().size());
        for (const Index3& nodes : network.triangles()) {
            rest_.emplace_back(network.stressFree(), nodes);
        }
    }

    void addForces(std::span<const Vec3> x, std::span<Vec3> f) const override {
        for (const int number : network_.wholeTriangles()) {
            const RestTriangle& rest = rest_[number];
            const Vec3 a = x[rest.node[1]] - x[rest.node[0]], b = x[rest.node[2]] - x[rest.node[0]];
            const Vec3 t = network_.shareOfTriangle(number) * rest.area *
                           rest.pullBack(law_.slope(rest.strain(edgeProducts(a, b))));
            const Vec3 f1 = 2 * t[0] * a + t[1] * b, f2 = t[1] * a + 2 * t[2] * b;
            f[rest.node[0]] += f1 + f2;
            f[rest.node[1]] -= f1;
            f[rest.node[2]] -= f2;
        }
    }

    double energy(std::span<const Vec3> x) const override {
        double sum = 0;
        for (const int number : network_.wholeTriangles()) {
            const RestTriangle& rest = rest_[number];
            sum += network_.shareOfTriangle(number) * rest.area * law_.energy(strainOf(rest, x));
        }
        return sum;
    }

    // That of the triangles of which a principal tension is positive. All of a triangle's energy is weakened, whatever
    // its tension is, so that forces stay continuous.
    void addTensileEnergy(std::span<const Vec3> x, std::span<double> ofTriangle) const override {
        for (const int number : network_.wholeTriangles()) {
            const RestTriangle& rest = rest_[number];
            const Vec3 e = strainOf(rest, x);
            if (isInTension(law_.slope(e))) {
                ofTriangle[number] += rest.area * law_.energy(e);
            }
        }
    }

    void addStiffness(std::span<const Vec3> x, Definiteness definiteness, Stiffness& stiffness) const override {
        for (const int number : network_.wholeTriangles()) {
            const RestTriangle& rest = rest_[number];
            const bool partwise = definiteness == Definiteness::partwise;
            const Vec3 e = strainOf(rest, x), slope = rest.pullBack(law_.slope(e));
            const Vec3 t = partwise ? positivePart(slope) : slope;
            const Matrix3x9 byNodes = strainByNodes(rest, x);
            const Mat3 curvature = law_.curvature(e);
            Matrix9 matrix =
                rest.area * byNodes.transpose() * (partwise ? positivePart(curvature) : curvature) * byNodes;
            // t11 a.a + t12 a.b + t22 b.b as a quadratic form of the nodes: a = x1 - x0, b = x2 - x0.
            Mat3 weights;
            weights << t[0] + t[1] + t[2], -t[0] - 0.5 * t[1], -t[2] - 0.5 * t[1],  //
                -t[0] - 0.5 * t[1], t[0], 0.5 * t[1],                               //
                -t[2] - 0.5 * t[1], 0.5 * t[1], t[2];
            for (int m = 0; m < 3; ++m) {
                for (int n = 0; n < 3; ++n) {
                    matrix.template block<3, 3>(3 * m, 3 * n) += 2 * rest.area * weights(m, n) * Mat3::Identity();
                }
            }
            matrix *= network_.shareOfTriangle(number);
            if (definiteness == Definiteness::semiDefinite) {
                matrix = semiDefinite(matrix);
            }
            stiffness.add(rest.node, matrix);
        }
    }

    double maxStiffness(std::span<const Vec3> x) const override {
        std::vector<double> ofNode(x.size(), 0.0);
        for (const int number : network_.wholeTriangles()) {
            const RestTriangle& rest = rest_[number];
            const double largest = largestEigenvalue(rest, x);
            for (const int node : rest.node) {
                ofNode[node] += largest;
            }
        }
        return ofNode.empty() ? 0.0 : *std::max_element(ofNode.begin(), ofNode.end());
    }

  private:
    using Matrix3x9 = Eigen::Matrix<double, 3, 9>;
    using Matrix9 = Eigen::Matrix<double, 9, 9>;

    static Vec3 strainOf(const RestTriangle& rest, std::span<const Vec3> x) {
        return rest.strain(edgeProducts(x[rest.node[1]] - x[rest.node[0]], x[rest.node[2]] - x[rest.node[0]]));
    }

    // Whether the stress dW/de, whose second component counts both off-diagonal entries, has a positive eigenvalue.
    static bool isInTension(const Vec3& slope) {
        const double trace = slope[0] + slope[2], determinant = slope[0] * slope[2] - 0.25 * slope[1] * slope[1];
        return trace > 0 || determinant < 0;
    }
    // Positive part (without the negative eigenvalues) of the tensor t, whose t12 counts both off-diagonal entries, and
    // of W''.
    static Vec3 positivePart(const Vec3& t) {
        Eigen::Matrix2d m{{t[0], 0.5 * t[1]}, {0.5 * t[1], t[2]}};
        m = positivePart(m);
        return {m(0, 0), 2 * m(0, 1), m(1, 1)};
    }
    template <int n>
    static Eigen::Matrix<double, n, n> positivePart(const Eigen::Matrix<double, n, n>& m) {
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n, n>> solver;
        solver.computeDirect(m);
        const auto& vectors = solver.eigenvectors();
        return vectors * solver.eigenvalues().cwiseMax(0).asDiagonal() * vectors.transpose();
    }

    static Matrix3x9 strainByNodes(const RestTriangle& rest, std::span<const Vec3> x) {
        const Vec3 a = x[rest.node[1]] - x[rest.node[0]], b = x[rest.node[2]] - x[rest.node[0]];
        Matrix3x9 products;
        products << -2 * a.transpose(), 2 * a.transpose(), Vec3::Zero().transpose(),  //
            -(a + b).transpose(), b.transpose(), a.transpose(),                       //
            -2 * b.transpose(), Vec3::Zero().transpose(), 2 * b.transpose();
        return rest.strainByProducts() * products;
    }

    // Largest eigenvalue of A0 Y^T W'' Y, Y = de/dx: A0 times that of D^(1/2) V^T (Y Y^T) V D^(1/2) with W'' = V D V^T,
    // where negative D are set to zero.
    double largestEigenvalue(const RestTriangle& rest, std::span<const Vec3> x) const {
        const Matrix3x9 byNodes = strainByNodes(rest, x);
        const Eigen::SelfAdjointEigenSolver<Mat3> material(law_.curvature(strainOf(rest, x)));
        const Mat3 root = material.eigenvectors() * material.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
        const Mat3 reduced = root.transpose() * (byNodes * byNodes.transpose()) * root;
        return rest.area * Eigen::SelfAdjointEigenSolver<Mat3>(reduced, Eigen::EigenvaluesOnly).eigenvalues()[2];
    }

    const Network& network_;
    Law law_;
    std::vector<RestTriangle> rest_;
};

}  // namespace corpuscle::membrane
