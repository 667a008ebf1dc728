// Continuum of the hexagonal lattice of harmonic bonds (paper, Eq 8), independent of the mesh: a spring lies along each
// of twelve directions n_i of the stress-free triangle, 15 degrees apart, and follows the stretch l_i of the sheet,
//     W = 1/3 Gs sum_i (l_i - 1)^2,     l_i^2 = n_i.C.n_i = 1 + n_i.e.n_i
// symbol | meaning                                             | unit
// Gs     | shear modulus                                       | N/m
// k      | spring constant of the lattice, Gs = sqrt(3)/4 k    | N/m
// Ks = 2 Gs; at small strain the law agrees with Skalak's law of C = 1/2. A lattice has three directions, W = 4/3 Gs
// times the sum over the three; the twelve directions are this lattice and its copies turned by 15, 30 and 45 degrees,
// a quarter each. W then differs from the mean over all directions by a fraction of at most 2e-9 at l1 = 1.2,
// l2 = 1/1.2, 1e-5 at 1.6, 1.6e-4 at 2 (six directions: 2e-4, 4e-3, 1e-2; three: 9 %, 16 %, 16 %), so that it does not
// depend on the orientation of the triangles.
#pragma once
#include <array>
#include <cmath>
#include <optional>

#include "core/settings.hpp"
#include "membrane/triangleLaw.hpp"

namespace corpuscle::membrane {

struct LatticeSheet final : TriangleLawOf<LatticeSheet> {
    std::optional<double> Gs, k;  // N/m

    double shearModulus() const { return Gs ? *Gs : 0.4330127018922193 * *k; }

    double energy(const Vec3& e) const override {
        double sum = 0;
        for (const Vec3& nn : directions) {
            const double y = nn.dot(e), stretched = y / (std::sqrt(1 + y) + 1);  // l - 1
            sum += stretched * stretched;
        }
        return 1.0 / 3 * shearModulus() * sum;
    }
    Vec3 slope(const Vec3& e) const override {
        Vec3 sum = Vec3::Zero();
        for (const Vec3& nn : directions) {
            sum += (1 - 1 / std::sqrt(1 + nn.dot(e))) * nn;
        }
        return 1.0 / 3 * shearModulus() * sum;
    }
    Mat3 curvature(const Vec3& e) const override {
        Mat3 sum = Mat3::Zero();
        for (const Vec3& nn : directions) {
            const double square = 1 + nn.dot(e);
            sum += 0.5 / (square * std::sqrt(square)) * nn * nn.transpose();
        }
        return 1.0 / 3 * shearModulus() * sum;
    }
    std::string constants() const override;
    static const Schema<LatticeSheet>& schema();

  private:
    // (n1 n1, 2 n1 n2, n2 n2) for n at 0, 15, ..., 165 degrees, so that n.e.n is a scalar product with the triple e.
    static constexpr double h = 0.8660254037844386, high = 0.9330127018922193, low = 0.0669872981077807;
    inline static const std::array<Vec3, 12> directions{
        Vec3(1, 0, 0),        Vec3(high, 0.5, low), Vec3(0.75, h, 0.25),  Vec3(0.5, 1, 0.5),
        Vec3(0.25, h, 0.75),  Vec3(low, 0.5, high), Vec3(0, 0, 1),        Vec3(low, -0.5, high),
        Vec3(0.25, -h, 0.75), Vec3(0.5, -1, 0.5),   Vec3(0.75, -h, 0.25), Vec3(high, -0.5, low)};
};

}  // namespace corpuscle::membrane
