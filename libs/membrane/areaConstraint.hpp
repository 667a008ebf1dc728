// Penalty energy that holds the area of the membrane near a target, triangle by triangle and as a whole. In the
// convention of spring networks, the two moduli add local + global to Ks and nothing to Gs, on any network:
//     E = local/2 sum_t (A_t - A_t0)^2/A_t0  +  global/2 (A - A_0)^2/A_0
// symbol  | meaning                                                                                              | unit
// local   | K_l, modulus of each triangle's area                                                                 | N/m
// global  | K_g, modulus of the whole area                                                                       | N/m
// A_0     | target area (key rest); default: the area of the stress-free mesh                                    | m^2
// A_t0    | stress-free area of the triangle times A_0/(area of the stress-free mesh)                            | m^2
// Open cells: a broken triangle no longer contributes to the local term. The global term is switched off permanently
// when the first triangle of the membrane breaks (a torn sheet has no lipid pressure to sustain). A mesh that was made
// with a border has both terms.
#pragma once
#include <memory>
#include <optional>

#include "core/settings.hpp"
#include "membrane/coordinates.hpp"
#include "membrane/network.hpp"
#include "membrane/term.hpp"

namespace corpuscle::membrane {

struct AreaConstraint {
    std::optional<double> local{}, global{};  // N/m
    std::optional<double> rest{};             // A_0, m^2

    double restArea(const Network& network) const;                         // A_0
    std::vector<std::unique_ptr<Term>> makeTerms(Network& network) const;  // one for each modulus that is given
    static const Schema<AreaConstraint>& schema();
};

// Area of a triangle with the unit normal n: dA/dx_0 = n x (x_2 - x_1)/2; dA/dx_1 and dA/dx_2 by cyclic permutation.
struct TriangleArea {
    static constexpr int nodes = 3;
    template <class Scalar = double>
    static Coordinate<3, Scalar> at(const std::array<Vec3Of<Scalar>, 3>& x) {
        using Vec = Vec3Of<Scalar>;
        using std::sqrt;
        const Vec u = x[1] - x[0], v = x[2] - x[0], w = x[2] - x[1];
        const Vec twice = u.cross(v);
        const Scalar square = twice.squaredNorm();
        if (!(square > 0)) {
            return {Scalar(0), {Vec::Zero(), Vec::Zero(), Vec::Zero()}};
        }
        const Scalar root = sqrt(square);
        const Vec half = twice / Scalar(2.0 * root);
        return {Scalar(0.5 * root), {Vec(half.cross(w)), Vec(v.cross(half)), Vec(half.cross(u))}};
    }
};

}  // namespace corpuscle::membrane
