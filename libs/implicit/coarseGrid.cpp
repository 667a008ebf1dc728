#include "implicit/coarseGrid.hpp"

#include <fftw3.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace corpuscle::implicit {

namespace {
constexpr std::size_t components = 3;
}

// Values on the grid and their Fourier transforms, component after component. Between walls each plane is transformed
// separately, otherwise all planes at once.
struct CoarseGrid::Plans {
    std::size_t nodes, modes;           // of one component
    std::size_t realPart, complexPart;  // of one part: what is transformed at once
    double* values;
    fftw_complex* spectrum;
    fftw_plan forward, backward;  // of one part

    Plans(const std::array<int, 3>& count, bool walls) {
        const int last = count[2] / 2 + 1;
        const auto plane = static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]);
        nodes = plane * static_cast<std::size_t>(count[2]);
        modes = plane * static_cast<std::size_t>(last);
        const auto parts = static_cast<std::size_t>(walls ? count[0] : 1);
        realPart = nodes / parts, complexPart = modes / parts;
        values = fftw_alloc_real(components * nodes);
        spectrum = fftw_alloc_complex(components * modes);
        const int rank = walls ? 2 : 3;
        const int* n = count.data() + (walls ? 1 : 0);
        const bool aligned = fftw_alignment_of(values + realPart) == fftw_alignment_of(values);
        const unsigned flags = FFTW_ESTIMATE | (aligned ? 0U : FFTW_UNALIGNED);
        forward = fftw_plan_dft_r2c(rank, n, values, spectrum, flags);
        backward = fftw_plan_dft_c2r(rank, n, spectrum, values, flags);
    }
    ~Plans() {
        fftw_destroy_plan(forward);
        fftw_destroy_plan(backward);
        fftw_free(values);
        fftw_free(spectrum);
    }
    Plans(const Plans&) = delete;
    Plans& operator=(const Plans&) = delete;

    Complex* mode(int component, std::size_t k) {
        return reinterpret_cast<Complex*>(spectrum) + static_cast<std::size_t>(component) * modes + k;
    }
    template <class F>
    void forParts(Planes planes, F&& f) {  // f(values, spectrum) for the parts that contain these planes
        const std::size_t parts = nodes / realPart;
        for (std::size_t part = 0; part < components * parts; ++part) {
            const auto plane = static_cast<int>(part % parts);
            if (parts == 1 || (plane >= planes.first && plane <= planes.last))
                f(values + part * realPart, spectrum + part * complexPart);
        }
    }
};

CoarseGrid::CoarseGrid(const particles::Box& box, double spacing) : box_(box) {
    axis_ = {2, 0, 1};
    for (int k = 0; k < 3; ++k)
        if (!box.periodic[static_cast<std::size_t>(k)]) axis_ = {k, (k + 1) % 3, (k + 2) % 3}, walls_ = true;
    for (int k = 0; k < 3; ++k) {
        const double length = box.size()[axis_[static_cast<std::size_t>(k)]];
        const bool wall = walls_ && k == 0;
        const int intervals = std::max(wall ? 2 : 1, static_cast<int>(std::lround(length / spacing)));
        step_[k] = length / intervals;
        count_[static_cast<std::size_t>(k)] = wall ? intervals - 1 : intervals;
    }
    plans_ = std::make_unique<Plans>(count_, walls_);
    quads_.resize(plans_->nodes);
}

CoarseGrid::~CoarseGrid() = default;

// Symbols of linear elements along a periodic axis, for the nodal values exp(i theta n).
CoarseGrid::Symbol CoarseGrid::symbol(int axis, int mode) const {
    const double h = step_[axis];
    const double theta = 2 * std::numbers::pi * mode / count_[static_cast<std::size_t>(axis)];
    return {h * (2 + std::cos(theta)) / 3, (2 - 2 * std::cos(theta)) / h, Complex(0, std::sin(theta))};
}

CoarseGrid::Block CoarseGrid::block(const std::array<Symbol, 3>& s) const {
    const auto product = [&](int p) {  // of the masses of all axes, with that of axis p replaced by its stiffness
        double value = 1;
        for (int k = 0; k < 3; ++k) value *= k == p ? s[k].stiffness : s[k].mass;
        return value;
    };
    Block gradients;  // (p, q): derivatives along p and q
    for (int p = 0; p < 3; ++p)
        for (int q = 0; q < 3; ++q)
            gradients(p, q) = p == q ? Complex(product(p)) : -s[p].slope * s[q].slope * s[3 - p - q].mass;
    if (sliding_ >= 0) {
        Block by = Block::Identity();  // maps to derivatives along the axes of the box
        const auto across = static_cast<int>(std::find(axis_.begin(), axis_.end(), sliding_) - axis_.begin());
        for (int k = 0; k < 3; ++k) by(across, k) -= tilt_[axis_[static_cast<std::size_t>(k)]];
        gradients = (by * gradients * by.transpose()).eval();
    }
    return Block::Identity() * (inertia_ * product(-1) + viscosity_ * gradients.trace()) + lambda_ * gradients;
}

void CoarseGrid::setCoefficients(double inertia, double viscosity, double lambda, const Periodicity& images) {
    const int sliding = images.slidingAxis();
    const Vec3 tilt = sliding < 0 ? Vec3::Zero() : Vec3(images.offset() / images.lengths()[sliding]);
    if (inertia == inertia_ && viscosity == viscosity_ && lambda == lambda_ && sliding == sliding_ && tilt == tilt_)
        return;
    inertia_ = inertia, viscosity_ = viscosity, lambda_ = lambda, sliding_ = sliding, tilt_ = tilt;
    factorise();
}

void CoarseGrid::factorise() {
    closedAt_ = -1;
    const int last = count_[2] / 2 + 1, planes = count_[0];
    // Normalisation of both transforms together.
    const double scale = 1.0 / (count_[1] * count_[2] * (walls_ ? 1 : planes));
    inverse_.resize(plans_->modes);
    const std::size_t perPlane = static_cast<std::size_t>(count_[1]) * static_cast<std::size_t>(last);
    if (walls_) upper_.resize(perPlane);
    const double h = step_[0];
    const Symbol own{2 * h / 3, 2 / h, 0}, next{h / 6, -1 / h, 0.5};  // of a plane with itself and with the next one
    for (int a = 0; a < count_[1]; ++a)
        for (int b = 0; b < last; ++b) {
            const Symbol sa = symbol(1, a), sb = symbol(2, b);
            const std::size_t k =
                static_cast<std::size_t>(a) * static_cast<std::size_t>(last) + static_cast<std::size_t>(b);
            if (!walls_) {
                for (int c = 0; c < planes; ++c)
                    inverse_[static_cast<std::size_t>(c) * perPlane + k] =
                        scale * block({symbol(0, c), sa, sb}).inverse();
                continue;
            }
            // Along the normal of the walls, the derivatives of test and trial function have the same matrix, with
            // opposite signs.
            const Block diagonal = block({own, sa, sb}) / scale, upper = block({next, sa, sb}) / scale;
            upper_[k] = upper;
            Block pivot = diagonal;
            for (int c = 0; c < planes; ++c) {
                const std::size_t at = static_cast<std::size_t>(c) * perPlane + k;
                if (c > 0) pivot = diagonal - upper.adjoint() * inverse_[at - perPlane] * upper;
                inverse_[at] = pivot.inverse();
            }
        }
}

// Eliminates the planes above `plane` from the top, where the right-hand side is zero: only their contribution to the
// pivots of `plane` is needed.
void CoarseGrid::close(int plane) {
    if (plane == closedAt_) return;
    const std::size_t perPlane = upper_.size();
    closed_.resize(perPlane);
    closedAt_ = plane;
    for (std::size_t k = 0; k < perPlane; ++k) {
        const Block& upper = upper_[k];
        const auto pivot = [&](int c) -> Block {
            return inverse_[static_cast<std::size_t>(c) * perPlane + k].inverse();
        };
        const Block own = pivot(0);  // no plane is below this one
        Block above = Block::Zero();
        for (int c = count_[0] - 1; c > plane; --c) above = upper * (own - above).inverse() * upper.adjoint();
        closed_[k] = (pivot(plane) - above).inverse();
    }
}

void CoarseGrid::solveModes(Planes planes) {
    using Vector = Eigen::Vector3cd;
    const auto get = [&](std::size_t k) {
        return Vector(*plans_->mode(0, k), *plans_->mode(1, k), *plans_->mode(2, k));
    };
    const auto put = [&](std::size_t k, const Vector& v) {
        for (int c = 0; c < 3; ++c) *plans_->mode(c, k) = v[c];
    };
    if (!walls_) {
        for (std::size_t k = 0; k < plans_->modes; ++k) put(k, inverse_[k] * get(k));
        return;
    }
    const bool open = planes.last < count_[0] - 1;
    if (open) close(planes.last);
    const std::size_t perPlane = upper_.size(), first = static_cast<std::size_t>(planes.first) * perPlane,
                      last = static_cast<std::size_t>(planes.last) * perPlane;
    for (std::size_t k = first + perPlane; k < last + perPlane; ++k)
        put(k, get(k) - upper_[k % perPlane].adjoint() * (inverse_[k - perPlane] * get(k - perPlane)));
    for (std::size_t k = 0; k < perPlane; ++k) put(last + k, (open ? closed_[k] : inverse_[last + k]) * get(last + k));
    for (std::size_t k = last; k-- > first;) put(k, inverse_[k] * (get(k) - upper_[k % perPlane] * get(k + perPlane)));
}

CoarseGrid::Planes CoarseGrid::planesOf(MPI_Comm comm, const std::vector<int>& particles) const {
    if (!walls_) return all();
    int range[2] = {-(count_[0] - 1), 0};  // minus the first plane; the last plane
    for (const int i : particles) {
        const Place& p = places_[static_cast<std::size_t>(i)];
        for (std::size_t side = 0; side < 2; ++side) {
            if (p.weight[0][side] == 0) continue;
            range[0] = std::max(range[0], -p.node[0][side]), range[1] = std::max(range[1], p.node[0][side]);
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, range, 2, MPI_INT, MPI_MAX, comm);
    return {-range[0], std::max(range[1], -range[0])};
}

void CoarseGrid::place(std::size_t particle, Vec3 x) {
    Place& p = places_[particle];
    if (sliding_ >= 0) x -= (x[sliding_] - box_.low[sliding_]) * tilt_;
    for (int k = 0; k < 3; ++k) {
        const int axis = axis_[static_cast<std::size_t>(k)], n = count_[static_cast<std::size_t>(k)];
        const double along = (box_.wrap(x[axis], axis) - box_.low[axis]) / step_[k];
        if (walls_ && k == 0) {
            const double inside = std::clamp((x[axis] - box_.low[axis]) / step_[k], 0.0, n + 1.0);
            const int first = std::min(static_cast<int>(inside), n);
            const auto weight = static_cast<float>(inside - first);
            if (first > 0) p.node[k][0] = first - 1, p.weight[k][0] = 1 - weight;  // node 0 is one step from the wall
            if (first < n) p.node[k][1] = first, p.weight[k][1] = weight;
        } else {
            const int first = std::min(static_cast<int>(along), n - 1);
            const auto weight = static_cast<float>(along - first);
            p.node[k][0] = first, p.node[k][1] = (first + 1) % n;
            p.weight[k][0] = 1 - weight, p.weight[k][1] = weight;
        }
    }
}

template <class F>
void CoarseGrid::forCorners(const Place& p, F&& f) const {
    for (std::size_t a = 0; a < 2; ++a)
        for (std::size_t b = 0; b < 2; ++b) {
            const int row = (p.node[0][a] * count_[1] + p.node[1][b]) * count_[2];
            const float weight = p.weight[0][a] * p.weight[1][b];
            for (std::size_t d = 0; d < 2; ++d) {
                const int node = row + p.node[2][d];
                f(static_cast<std::size_t>(node), static_cast<double>(weight * p.weight[2][d]));
            }
        }
}

template <class F>
void CoarseGrid::forParticles(const std::vector<int>* particles, std::size_t all, F&& f) const {
    if (particles)
        for (const int i : *particles) f(static_cast<std::size_t>(i));
    else
        for (std::size_t i = 0; i < all; ++i) f(i);
}

std::span<double> CoarseGrid::values() { return {plans_->values, components * plans_->nodes}; }

template <class Real>
void CoarseGrid::gather(const Real* r, const std::vector<int>* particles, Planes planes) {
    const std::size_t first = firstOf(planes.first), last = firstOf(planes.last + 1);
    std::fill(quads_.begin() + static_cast<std::ptrdiff_t>(first), quads_.begin() + static_cast<std::ptrdiff_t>(last),
              Quad::Zero());
    forParticles(particles, own_, [&](std::size_t i) {
        const Quad value = Eigen::Map<const Eigen::Array<Real, 4, 1>>(r + 4 * i).template cast<double>();
        forCorners(places_[i], [&](std::size_t node, double weight) { quads_[node] += weight * value; });
    });
    for (std::size_t c = 0; c < components; ++c)
        for (std::size_t g = first; g < last; ++g) plans_->values[c * plans_->nodes + g] = quads_[g][axis_[c]];
}

void CoarseGrid::solve(MPI_Comm comm, Planes planes) {
    int ranks = 1;
    MPI_Comm_size(comm, &ranks);
    if (ranks > 1)
        forValues(planes, [&](std::size_t first, std::size_t last) {
            MPI_Allreduce(MPI_IN_PLACE, plans_->values + first, static_cast<int>(last - first), MPI_DOUBLE, MPI_SUM,
                          comm);
        });
    plans_->forParts(planes, [&](double* values, fftw_complex* spectrum) {
        fftw_execute_dft_r2c(plans_->forward, values, spectrum);
    });
    solveModes(planes);
    plans_->forParts(planes, [&](double* values, fftw_complex* spectrum) {
        fftw_execute_dft_c2r(plans_->backward, spectrum, values);
    });
}

template <class Real>
void CoarseGrid::spread(Real* z, const std::vector<int>* particles, Planes planes) {
    for (std::size_t g = firstOf(planes.first); g < firstOf(planes.last + 1); ++g) {
        for (std::size_t c = 0; c < components; ++c) quads_[g][axis_[c]] = plans_->values[c * plans_->nodes + g];
        quads_[g][3] = 0;
    }
    forParticles(particles, places_.size(), [&](std::size_t i) {
        Quad sum = Quad::Zero();
        forCorners(places_[i], [&](std::size_t node, double weight) { sum += weight * quads_[node]; });
        Eigen::Map<Eigen::Array<Real, 4, 1>>(z + 4 * i) += sum.template cast<Real>();
    });
}

template <class Real>
void CoarseGrid::add(MPI_Comm comm, const Real* r, Real* z) {
    gather(r);
    solve(comm);
    spread(z);
}

template void CoarseGrid::gather(const double*, const std::vector<int>*, Planes);
template void CoarseGrid::gather(const float*, const std::vector<int>*, Planes);
template void CoarseGrid::spread(double*, const std::vector<int>*, Planes);
template void CoarseGrid::spread(float*, const std::vector<int>*, Planes);
template void CoarseGrid::add(MPI_Comm, const double*, double*);
template void CoarseGrid::add(MPI_Comm, const float*, float*);

}  // namespace corpuscle::implicit
