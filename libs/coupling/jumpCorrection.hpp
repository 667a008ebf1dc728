// What the reach of a node's weights takes from its velocity, put back.
//
// A tangential load per area f_t of the membrane bends the velocity of the fluid across it: mu_out du_t/dn - mu_in du_t/dn = -f_t. A node takes
// a mean over this kink, of a flow that is driven by a load spread with the same weights, and so is behind the membrane by
//
//     w = delta f_t/(mu_in + mu_out),   delta = E|s - s'| = 0.586 dx
// s and s' are distances from the membrane, independent, as the weights of immersed.hpp are distributed over them (Wendland C2 within 2 dx,
// integrated along the membrane). Nothing of this kind happens across it, where incompressibility keeps the velocity smooth. It is the one error
// of first order in dx of the coupling (docs/coupling.md, with figures), and with it nodes move with
//
//     u_m = P S u + M f,   M = delta/((mu_in + mu_out) A) (1 - n n^T)
// n: direction of dV/dx, the gradient of the enclosed volume, so that w does not change it; A = |dV/dx|, the area of a node. Where the force depends
// on the velocity, f = l - R u_m, the equation
//
//     (1 + M^1/2 R M^1/2) y = M^1/2 (l - R P S u),   w = M^1/2 y
// is solved on the nodes by conjugate gradients, the same on all ranks. The fluid feels S^T P (R^-1 + M)^-1 P S: symmetric, positive semi-definite, and
// softer than R. The power w.f >= 0 is what the fluid dissipates in the kink.
#pragma once
#include <span>
#include <vector>

#include "coupling/cell.hpp"

namespace corpuscle::coupling {

class JumpCorrection {
  public:
    using Vectors = std::vector<Vec3>;
    static constexpr double reachInSpacings = 0.586;  // delta
    static constexpr double tolerance = 1e-6;         // of the residual
    static constexpr int most = 400;                  // iterations

    // viscosity: of the fluid outside cells [Pa s].
    JumpCorrection(const std::vector<Cell>& cells, double spacing, double viscosity)
        : cells_(cells), spacing_(spacing), viscosity_(viscosity) {}

    // Where nodes are now.
    void place();
    // v += M f.
    void addSlip(std::span<const Vec3> f, Vectors& v) const;
    // v: P S u on entry, u_m at the end; f: l on entry, l - R u_m at the end. resist(u, f): f -= R u. Throws Failure(numerics), on all ranks, where it
    // does not converge.
    template <class Resist>
    void solve(Resist&& resist, Vectors& v, Vectors& f) const {
        resist(v, f);
        const std::size_t n = v.size();
        Vectors y(n, Vec3::Zero()), r = scaled(f), p = r, q(n);
        double square = dot(r, r);
        const double enough = tolerance * tolerance * square;
        for (int k = 0; square > enough; ++k) {
            if (k == most) fail();
            Vectors resisted(n, Vec3::Zero());
            resist(scaled(p), resisted);
            q = scaled(resisted);
            for (std::size_t m = 0; m < n; ++m) q[m] = p[m] - q[m];
            const double alpha = square / dot(p, q), before = square;
            for (std::size_t m = 0; m < n; ++m) y[m] += alpha * p[m], r[m] -= alpha * q[m];
            square = dot(r, r);
            for (std::size_t m = 0; m < n; ++m) p[m] = r[m] + square / before * p[m];
        }
        const Vectors w = scaled(y);
        for (std::size_t m = 0; m < n; ++m) v[m] += w[m];
        resist(w, f);
    }

  private:
    static double dot(const Vectors& a, const Vectors& b);
    Vectors scaled(const Vectors& v) const;  // M^1/2 v
    [[noreturn]] static void fail();

    const std::vector<Cell>& cells_;
    double spacing_, viscosity_;
    std::vector<double> root_;  // of the mobility [(m/(N s))^1/2]
    Vectors normal_;
};

}  // namespace corpuscle::coupling
