// Preconditioned conjugate gradients for A x = r from x = 0, in the form of Chronopoulos and Gear (J. Comput. Appl.
// Math. 25 (1989) 153): one reduction per iteration adds up all its scalar products over the ranks. The method is
// flexible (Notay, SIAM J. Sci. Comput. 22 (2000) 1444, with one direction kept): the direction p = z + beta p_before
// is made conjugate to the previous one by
//     beta = -z.s/sigma,   s = A p_before,   sigma = p_before.s;     p.A p = z.A z - (z.s)^2/sigma
// whatever z is, so that the preconditioner may differ slightly from one application to the next, as one with an inner
// iteration does.
//
// The solver of the fluid stops by the energy of the error (StopByEnergy). Step k reduces |x - x_k|_A^2 by
// g_k = alpha_k gamma_k (Hestenes and Stiefel 1952), so that the error is the sum of the reductions of all later steps.
// These are assumed to decrease by a factor q per step, as the last few did: q is the largest of the mean factors over
// the last one, two and three steps, and the sum is g_k q/(1 - q). A sum over steps already made (Strakos and Tichy,
// ETNA 13 (2002) 56) is the error before those steps, which is far above the present one where convergence is fast. A
// norm of the residual would give too little weight to smooth modes, the more so the finer the resolution.
#pragma once
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "particles/particleStore.hpp"

namespace corpuscle::implicit {

// Rows [first, last) of a vector that belong to other ranks, which count them in scalar products. `apply` and
// `precondition` keep them equal to the rows of those ranks, to rounding.
struct Copies {
    std::size_t first = 0, last = 0;
    template <class F>
    void forCounted(std::size_t size, F&& f) const {  // the rows that this rank counts
        for (std::size_t k = 0; k < first; ++k) f(k);
        for (std::size_t k = last; k < size; ++k) f(k);
    }
};

struct Convergence {
    int iterations = 0;
    double energy = 0;  // x.A x [W]
    double error = 0;   // estimate of |error|_A^2 [W]
    bool reached = true;
};

// Stops where the estimated |error|_A^2 is below tolerance^2 max(reference, x.A x).
class StopByEnergy {
  public:
    static constexpr std::size_t window = 3, least = 2;  // steps over which q is taken; least number of steps
    // Of the allowed energy: a smaller r.M^-1 r is rounding, even for the smoothest error.
    static constexpr double negligible = 1e-10;
    // Whether `before` is called ahead of the matrix product, at the cost of a separate reduction: where products are
    // expensive.
    static constexpr bool looksFirst = false;

    StopByEnergy(double reference, double tolerance) : reference_(reference), tolerance2_(tolerance * tolerance) {}

    // Whether to stop. gamma: r.M^-1 r before a step; gain: by how much the step has reduced |error|_A^2.
    bool before(double gamma, const Convergence& c) const { return gamma >= 0 && gamma <= negligible * allowed(c); }
    bool after(double gain, Convergence& c) {
        gains_.push_back(gain);
        c.error = remaining();
        return gains_.size() >= least && c.error <= allowed(c);
    }

  private:
    double allowed(const Convergence& c) const { return tolerance2_ * std::max(reference_, c.energy); }
    double remaining() const {
        const std::size_t last = gains_.size() - 1;
        double q = last == 0 ? 1 : 0;
        for (std::size_t k = 1; k <= std::min(window, last); ++k)
            q = std::max(q, std::pow(gains_[last] / gains_[last - k], 1 / static_cast<double>(k)));
        return q < 1 ? gains_[last] * q / (1 - q) : std::numeric_limits<double>::infinity();
    }

    double reference_, tolerance2_;
    std::vector<double> gains_;
};

template <class Real>
class ConjugateGradients {
  public:
    using Field = particles::AlignedVector<Real>;
    static constexpr int most = 2000;

    // Another quantity that is linear in the velocity: `apply` leaves its value for the last z in `image`, and the
    // solver adds its value for x to `value`.
    struct Carried {
        Field value, image;
    };

    // apply(z, w): w = A z; precondition(r, z): z = M^-1 r. At the end r is the residual; in rows where z is always
    // zero, it is the initial r less A x. Stops where the estimated |error|_A^2 is below tolerance^2 max(reference,
    // x.A x). Collective.
    template <class Apply, class Precondition>
    Convergence solve(MPI_Comm comm, Field& r, Field& x, double reference, double tolerance, Apply&& apply,
                      Precondition&& precondition, Copies copies = {}, Carried* carried = nullptr) {
        return solveUntil(comm, r, x, StopByEnergy(reference, tolerance), std::forward<Apply>(apply),
                          std::forward<Precondition>(precondition), copies, carried);
    }
    // The same with another criterion: `stop` has the functions of StopByEnergy. rows: those that this rank counts, by
    // forCounted as in Copies.
    template <class Stop, class Apply, class Precondition, class Rows>
    Convergence solveUntil(MPI_Comm comm, Field& r, Field& x, Stop stop, Apply&& apply, Precondition&& precondition,
                           const Rows& rows, Carried* carried = nullptr) {
        const std::size_t n = r.size();
        for (Field* f : {&z_, &w_}) f->resize(n);
        for (Field* f : {&p_, &s_, &x}) f->assign(n, Real(0));
        if (carried) carriedDirection_.assign(carried->value.size(), Real(0));
        Convergence c;
        double sigma = 0;
        for (;; ++c.iterations) {
            precondition(r, z_);
            double sums[3] = {0, 0, 0};
            if constexpr (Stop::looksFirst) {
                rows.forCounted(
                    n, [&](std::size_t k) { sums[0] += static_cast<double>(r[k]) * static_cast<double>(z_[k]); });
                MPI_Allreduce(MPI_IN_PLACE, sums, 1, MPI_DOUBLE, MPI_SUM, comm);
                if (stop.before(sums[0], c)) break;
            }
            apply(z_, w_);
            rows.forCounted(n, [&](std::size_t k) {
                const auto z = static_cast<double>(z_[k]);
                if constexpr (!Stop::looksFirst) sums[0] += static_cast<double>(r[k]) * z;
                sums[1] += static_cast<double>(w_[k]) * z;
                sums[2] += static_cast<double>(s_[k]) * z;
            });
            constexpr int known = Stop::looksFirst ? 1 : 0;
            MPI_Allreduce(MPI_IN_PLACE, sums + known, 3 - known, MPI_DOUBLE, MPI_SUM, comm);
            const auto [gamma, delta, overlap] = sums;
            if (!Stop::looksFirst && stop.before(gamma, c)) break;
            const double beta = c.iterations > 0 ? -overlap / sigma : 0;
            sigma = delta + beta * overlap;
            const double alpha = gamma / sigma;
            if (!(gamma > 0) || !std::isfinite(alpha) || alpha <= 0 || c.iterations == most) {
                c.reached = false;
                break;
            }
            const auto a = static_cast<Real>(alpha), b = static_cast<Real>(beta);
            for (std::size_t k = 0; k < n; ++k) {
                p_[k] = z_[k] + b * p_[k];
                s_[k] = w_[k] + b * s_[k];
                x[k] += a * p_[k];
                r[k] -= a * s_[k];
            }
            if (carried)
                for (std::size_t k = 0; k < carriedDirection_.size(); ++k) {
                    carriedDirection_[k] = carried->image[k] + b * carriedDirection_[k];
                    carried->value[k] += a * carriedDirection_[k];
                }
            c.energy += alpha * gamma;
            if (stop.after(alpha * gamma, c)) {
                ++c.iterations;
                break;
            }
        }
        return c;
    }

  private:
    Field z_, w_, p_, s_, carriedDirection_;
};

}  // namespace corpuscle::implicit
