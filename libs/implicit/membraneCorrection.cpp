#include "implicit/membraneCorrection.hpp"

#include <algorithm>
#include <numeric>

#include "core/communicator.hpp"
#include "coupling/adjoint.hpp"

namespace corpuscle::implicit {

namespace {

using Vectors = coupling::Immersed::Vectors;
using Flat = ConjugateGradients<double>::Field;  // the same as one array of numbers

Vectors vectorsOf(const Flat& flat) {
    Vectors vectors(flat.size() / 3);
    std::copy(flat.begin(), flat.end(), reinterpret_cast<double*>(vectors.data()));
    return vectors;
}
Flat flatOf(const Vectors& vectors) {
    const auto* const numbers = reinterpret_cast<const double*>(vectors.data());
    return {numbers, numbers + 3 * vectors.size()};
}

// Counts the rows of the nodes of cells that this rank owns.
struct OwnedRows {
    const coupling::Immersed& immersed;
    int rank;
    template <class F>
    void forCounted(std::size_t, F&& f) const {
        immersed.layout().forOwned(immersed.cells(), rank, [&](std::size_t m) {
            for (std::size_t k = 3 * m; k < 3 * m + 3; ++k) f(k);
        });
    }
};

// Stops where s.K' s of the residual s is a small share of r.z (membraneCorrection.hpp). energy: r.B r. With A the
// matrix of the node system, r.z is r.B r less x.A x.
struct StopByShare {
    static constexpr bool looksFirst = true;
    double energy, share2;
    int most;
    bool before(double square, const Convergence& c) const {
        return c.iterations == most || square <= share2 * (energy - c.energy);
    }
    static bool after(double, const Convergence&) { return false; }
};

}  // namespace

template <class Real>
Vectors MembraneCorrection<Real>::resistance(const Parts& parts, const Vectors& u) const {
    Vectors f(u.size(), Vec3::Zero());
    parts.immersed.addResistance(parts.time, u, f);
    for (Vec3& a : f) a = -a;
    return f;
}

template <class Real>
void MembraneCorrection<Real>::scatter(const Parts& parts, const Vectors& f) {
    for (const int i : parts.immersed.touched())
        std::fill_n(scattered_.data() + 4 * static_cast<std::size_t>(i), 4, 0.0);
    parts.immersed.spread(f, scattered_);
}

template <class Real>
template <class Force>
Vectors MembraneCorrection<Real>::onNodes(const Parts& parts, Force&& force) {
    const std::vector<int>& near = parts.immersed.touched();
    for (const int i : near)
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t at = 4 * static_cast<std::size_t>(i) + k;
            image_[at] = static_cast<double>(parts.inverse[static_cast<std::size_t>(i)]) * force(at);
        }
    parts.grid.spread(image_.data(), near, parts.planes);
    return parts.immersed.interpolate(image_.data());
}

template <class Real>
Vectors MembraneCorrection<Real>::solve(const Parts& parts, const Vectors& first, double energy) {
    const Communicator ranks(parts.comm);
    const Flat atFirst = flatOf(first);
    Flat residual = flatOf(resistance(parts, first)), x;  // K' s of the residual s
    left_.value.assign(atFirst.size(), 0.0), left_.image.resize(atFirst.size());
    const Convergence c = solver_.solveUntil(
        parts.comm, residual, x, StopByShare{ranks.sum(energy), tolerance * tolerance, most},
        [&](const Flat& z, Flat& w) {
            scatter(parts, vectorsOf(residual));  // the residual is K' z
            parts.grid.gather(scattered_.data(), parts.immersed.touched(), parts.planes);
            parts.grid.solve(parts.comm, parts.planes);
            const Vectors t = onNodes(parts, [&](std::size_t at) { return scattered_[at]; });  // N K' z
            const Flat image = flatOf(t), change = flatOf(resistance(parts, t));
            for (std::size_t k = 0; k < w.size(); ++k) left_.image[k] = z[k] + image[k], w[k] = residual[k] + change[k];
        },
        [&](const Flat&, Flat& z) {
            for (std::size_t k = 0; k < z.size(); ++k) z[k] = atFirst[k] - left_.value[k];
        },
        OwnedRows{parts.immersed, ranks.rank()}, &left_);
    iterations_ += c.iterations;
    return resistance(parts, vectorsOf(x));
}

template <class Real>
void MembraneCorrection<Real>::apply(MPI_Comm comm, coupling::Immersed& immersed, CoarseGrid& grid, double time,
                                     const Field& inverse, std::size_t own, const Field& r, Field& z) {
    const std::vector<int>&near = immersed.touched(), &nearOthers = immersed.touchedOthers();
    scattered_.resize(r.size()), image_.resize(r.size());
    const Parts parts{comm, immersed, grid, grid.planesOf(comm, near), time, inverse};
    const std::span<double> values = grid.values();
    grid.gather(r.data());
    gathered_.assign(values.begin(), values.end());
    grid.solve(comm);
    double energy = std::inner_product(gathered_.begin(), gathered_.end(), values.begin(), 0.0);
    for (std::size_t i = 0; i < own; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            energy +=
                static_cast<double>(inverse[i]) * static_cast<double>(r[4 * i + k]) * static_cast<double>(r[4 * i + k]);
    const Vectors y = solve(parts, onNodes(parts, [&](std::size_t at) { return static_cast<double>(r[at]); }), energy);

    // z = B (r - S^T y)
    scatter(parts, y);
    grid.gather(scattered_.data(), near, parts.planes);
    grid.forValues(parts.planes, [&](std::size_t from, std::size_t to) {
        for (std::size_t g = from; g < to; ++g) gathered_[g] -= values[g];
    });
    std::copy(gathered_.begin(), gathered_.end(), values.begin());
    grid.solve(comm);
    for (const int i : nearOthers) std::fill_n(scattered_.data() + 4 * static_cast<std::size_t>(i), 4, 0.0);
    immersed.spreadToOthers(y, scattered_);
    for (std::size_t i = 0; i < inverse.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) z[4 * i + k] = inverse[i] * r[4 * i + k];
        z[4 * i + 3] = 0;
    }
    for (const std::vector<int>* particles : {&near, &nearOthers})
        for (const int i : *particles)
            for (std::size_t k = 0; k < 4; ++k) {
                const std::size_t at = 4 * static_cast<std::size_t>(i) + k;
                z[at] -= inverse[static_cast<std::size_t>(i)] * static_cast<Real>(scattered_[at]);
            }
    grid.spread(z.data());
}

template class MembraneCorrection<double>;
template class MembraneCorrection<float>;

}  // namespace corpuscle::implicit
