#include "implicit/membraneCorrection.hpp"

#include <algorithm>
#include <numeric>

#include "core/communicator.hpp"
#include "coupling/adjoint.hpp"

namespace corpuscle::implicit {

namespace {

using Vectors = coupling::Immersed::Vectors;

double dot(const Vectors& a, const Vectors& b) {
    double sum = 0;
    for (std::size_t m = 0; m < a.size(); ++m) sum += a[m].dot(b[m]);
    return sum;
}

void add(Vectors& a, double factor, const Vectors& b) {
    for (std::size_t m = 0; m < a.size(); ++m) a[m] += factor * b[m];
}

}  // namespace

template <class Real>
void MembraneCorrection<Real>::apply(MPI_Comm comm, const coupling::Immersed& immersed, CoarseGrid& grid, double time,
                                     const Field& inverse, std::size_t own, const Field& r, Field& z) {
    const std::vector<int>& near = immersed.touched();
    const std::size_t size = r.size();
    scattered_.resize(size), image_.resize(size);
    const std::span<double> values = grid.values();
    const CoarseGrid::Planes planes = grid.planesOf(comm, near);
    const auto stiffness = [&](const Vectors& u) {  // K' u
        Vectors f(u.size(), Vec3::Zero());
        immersed.addResistance(time, u, f);
        for (Vec3& a : f) a = -a;
        return f;
    };
    // From the grid's values and what acts on a particle: S B.
    const auto onNodes = [&](auto&& force) {
        for (const int i : near)
            for (std::size_t k = 0; k < 4; ++k) {
                const std::size_t at = 4 * static_cast<std::size_t>(i) + k;
                image_[at] = static_cast<double>(inverse[static_cast<std::size_t>(i)]) * force(at);
            }
        grid.spread(image_.data(), near, planes);
        return immersed.interpolate(image_.data());
    };
    const auto scatter = [&](const Vectors& f) {  // S^T f
        for (const int i : near) std::fill_n(scattered_.data() + 4 * static_cast<std::size_t>(i), 4, 0.0);
        immersed.spread(f, scattered_);
    };

    grid.gather(r.data());
    gathered_.assign(values.begin(), values.end());
    grid.solve(comm);
    double energy = std::inner_product(gathered_.begin(), gathered_.end(), values.begin(), 0.0);
    for (std::size_t i = 0; i < own; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            energy +=
                static_cast<double>(inverse[i]) * static_cast<double>(r[4 * i + k]) * static_cast<double>(r[4 * i + k]);
    energy = Communicator(comm).sum(energy);  // r.B r, from which y takes r.B S^T y
    const Vectors first = onNodes([&](std::size_t at) { return static_cast<double>(r[at]); });
    Vectors residual = first, y(residual.size(), Vec3::Zero()), image = stiffness(residual);  // K' residual
    Vectors direction = residual, s = image;                                                  // K' direction
    double square = dot(residual, image);
    for (int k = 0; k < most && square > tolerance * tolerance * (energy - dot(first, y)); ++k, ++iterations_) {
        scatter(s);
        grid.gather(scattered_.data(), near, planes);
        grid.solve(comm, planes);
        const Vectors t = onNodes([&](std::size_t at) { return scattered_[at]; });  // N K' direction
        const double alpha = square / (dot(s, direction) + dot(s, t));
        add(y, alpha, s);
        add(residual, -alpha, direction), add(residual, -alpha, t);
        add(image, -alpha, s), add(image, -alpha, stiffness(t));
        const double before = square;
        square = dot(residual, image);
        const double beta = square / before;
        for (std::size_t m = 0; m < direction.size(); ++m) {
            direction[m] = residual[m] + beta * direction[m];
            s[m] = image[m] + beta * s[m];
        }
    }

    // z = B (r - S^T y)
    scatter(y);
    grid.gather(scattered_.data(), near, planes);
    grid.forValues(planes, [&](std::size_t from, std::size_t to) {
        for (std::size_t g = from; g < to; ++g) gathered_[g] -= values[g];
    });
    std::copy(gathered_.begin(), gathered_.end(), values.begin());
    grid.solve(comm);
    const std::vector<int>& nearOthers = immersed.touchedOthers();
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
