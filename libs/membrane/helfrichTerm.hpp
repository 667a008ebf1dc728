// The term of helfrichBending.hpp. With C_v = 2 M_v/A_v, M = sum_v M_v, and the energy of the area difference written
// as k/2 (M - M0)^2 with k = 4 pi alpha kappa/A0:
//     dE/dM_v = 2 kappa (C_v - c0) + k (M - M0),     dE/dA_v = kappa/2 (c0^2 - C_v^2)
//     F = -sum_v (dE/dM_v grad M_v + dE/dA_v grad A_v)
// The energy of a node is convex in (M_v, A_v), and its second derivative in these has rank one:
//     E'' = sum_v [4 kappa/A_v w_v w_v^T + dE/dM_v grad^2 M_v + dE/dA_v grad^2 A_v] + k grad M grad M^T,
//         w_v = grad M_v - C_v/2 grad A_v
// An element of the stiffness is a node with its ring of neighbours. maxStiffness bounds the parts of rank one only, by
//     |w_n| sum_m |w_m| summed over the elements of a node n, which is at least the eigenvalue since (w.u)^2 <= sum
//         |w_m| sum |w_n||u_n|^2.
#pragma once
#include "membrane/areaConstraint.hpp"
#include "membrane/coordinates.hpp"
#include "membrane/network.hpp"
#include "membrane/term.hpp"

namespace corpuscle::membrane {

// Edge length times dihedral angle of a hinge, l theta [m].
struct EdgeCurvature {
    static constexpr int nodes = 4;
    template <class Scalar = double>
    static Coordinate<4, Scalar> at(const std::array<Vec3Of<Scalar>, 4>& x) {
        using Vec = Vec3Of<Scalar>;
        using std::sqrt;
        auto q = DihedralAngle::at<Scalar>(x);
        const Vec e = x[1] - x[0];
        const Scalar l = sqrt(e.squaredNorm());
        if (!(l > 0)) {
            return q;
        }
        for (Vec& g : q.gradient) {
            g = Vec(g * l);
        }
        const Vec stretch = e * Scalar(q.value / l);
        q.gradient[0] -= stretch;
        q.gradient[1] += stretch;
        q.value *= l;
        return q;
    }
};

// Share of a triangle of area A that belongs to its first node [m^2]. With the squared lengths L_k of the edges
// opposite to nodes k and S their sum,
//     share = A/2 (1 - r_0/(r_0 + r_1 + r_2)),   r_k = (p_k + sqrt(p_k^2 + eps^2))/2,   p_k = L_k (S - 2 L_k)/S^2
// r_k = p_k would give the Voronoi share, bounded by the midpoints of the edges and the circumcentre (p_k: its
// barycentric coordinates up to a factor, 1/9 in an equilateral triangle), which is negative in obtuse triangles. r_k
// is a smooth max(p_k, 0): it keeps the circumcentre inside and the shares positive, and the force has derivatives of
// every order, which Newton's method needs. The three shares sum to A. The function returns those of the first Count
// nodes.
template <int Count, class Scalar>
std::array<Coordinate<3, Scalar>, Count> nodeAreas(const std::array<Vec3Of<Scalar>, 3>& x) {
    using Vec = Vec3Of<Scalar>;
    using std::sqrt;
    constexpr double eps = 0.03;
    const Coordinate<3, Scalar> area = TriangleArea::at<Scalar>(x);
    const std::array<Vec, 3> edge{x[2] - x[1], x[0] - x[2], x[1] - x[0]};  // opposite to each node, same orientation
    const std::array<Scalar, 3> L{edge[0].squaredNorm(), edge[1].squaredNorm(), edge[2].squaredNorm()};
    const Scalar S = L[0] + L[1] + L[2], over = 1.0 / S, over2 = over * over;
    std::array<Scalar, 3> r;
    std::array<std::array<Scalar, 3>, 3> dr;  // dr[k][m] = dr_k/dL_m
    for (int k = 0; k < 3; ++k) {
        const Scalar p = L[k] * (S - 2.0 * L[k]) * over2, root = sqrt(p * p + eps * eps);
        r[k] = 0.5 * (p + root);
        const Scalar slope = r[k] / root, common = slope * (L[k] * over2 - 2.0 * p * over);
        dr[k] = {common, common, common};
        dr[k][k] += slope * (S - 4.0 * L[k]) * over2;
    }
    const Scalar overR = 1.0 / (r[0] + r[1] + r[2]), scale = overR * area.value;
    std::array<Coordinate<3, Scalar>, Count> shares;
    for (int j = 0; j < Count; ++j) {
        const Scalar part = r[j] * overR, kept = 0.5 * (1.0 - part);
        shares[j].value = kept * area.value;
        for (int k = 0; k < 3; ++k) {
            shares[j].gradient[k] = area.gradient[k] * kept;
        }
        for (int m = 0; m < 3; ++m) {  // -A/2 d(part)/dL_m dL_m, dL_m = 2 edge.d(edge)
            const Vec step = edge[m] * Scalar((dr[j][m] - part * (dr[0][m] + dr[1][m] + dr[2][m])) * scale);
            shares[j].gradient[(m + 2) % 3] -= step;
            shares[j].gradient[(m + 1) % 3] += step;
        }
    }
    return shares;
}

// Share of the first node, as an internal coordinate.
struct NodeArea {
    static constexpr int nodes = 3;
    template <class Scalar = double>
    static Coordinate<3, Scalar> at(const std::array<Vec3Of<Scalar>, 3>& x) {
        return nodeAreas<1, Scalar>(x)[0];
    }
};

struct HelfrichModuli {
    double kappa = 0;          // J
    double c0 = 0;             // 1/m
    double difference = 0;     // k of the area difference, J/m^2; 0: none
    double restCurvature = 0;  // M0 = DeltaA0/(2 D), m
};

class HelfrichTerm final : public Term {
  public:
    HelfrichTerm(const Network& network, const HelfrichModuli& moduli);
    void addForces(std::span<const Vec3> x, std::span<Vec3> f) const override;
    double energy(std::span<const Vec3> x) const override;
    void addStiffness(std::span<const Vec3> x, Definiteness definiteness, Stiffness& stiffness) const override;
    double maxStiffness(std::span<const Vec3> x) const override;

  private:
    struct State;  // M_v, A_v and their parts
    struct Ring;   // a node, its neighbours and w_v

    State evaluate(std::span<const Vec3> x) const;
    std::vector<Ring> rings(const State& state) const;
    void addCurvature(std::span<const Vec3> x, const State& state, const Ring& ring, Eigen::MatrixXd& matrix) const;
    std::vector<Vec3> gradientOfIntegral(const State& state) const;  // of M = sum M_v

    const Network& network_;
    HelfrichModuli moduli_;
    std::vector<int> valence_;  // number of edges of each node in the original mesh
};

}  // namespace corpuscle::membrane
