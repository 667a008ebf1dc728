#include "coupling/nodeFluidMap.hpp"

#include <fmt/core.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/communicator.hpp"
#include "core/together.hpp"
#include "membrane/surface.hpp"

namespace corpuscle::coupling {

using particles::ParticleSystem;

namespace {

constexpr int fewest = 10;           // particles for more than Shepard's weights
constexpr std::size_t moments = 16;  // upper triangle of sum W b b^T with the basis b, and how many

double wendland(double r) {
    const double s = 1 - r, s2 = s * s;
    return (1 + 4 * r) * s2 * s2;
}

Eigen::Matrix<double, 5, 1> basis(const Vec3& q) { return {1, q[0], q[1], q[2], q.squaredNorm()}; }

// All images of x within `reach` of the rank's brick.
template <class F>
void forImages(const ParticleSystem& system, const Vec3& x, double reach, F&& f) {
    const Periodicity& periodicity = system.periodicity();
    const particles::Brick& brick = system.decomposition().own();
    const Vec3 inside = periodicity.wrap(x);
    int images[3];
    for (int k = 0; k < 3; ++k) images[k] = periodicity.isAlong(k) ? 1 : 0;
    for (int a = -images[0]; a <= images[0]; ++a)
        for (int b = -images[1]; b <= images[1]; ++b)
            for (int c = -images[2]; c <= images[2]; ++c) {
                const Vec3 image = inside + periodicity.image({a, b, c}).shift;
                if (particles::distanceSquared(image, brick.low, brick.high) < reach * reach) f(image);
            }
}

}  // namespace

void NodeFluidMap::place(const Cells& cells, const NodeLayout& layout, const ParticleSystem& system,
                         const std::vector<double>& volume) {
    findEntries(cells, system, volume);
    std::vector<char> isMine(layout.nodes());
    for (std::size_t m = 0; m < isMine.size(); ++m) isMine[m] = own_.first[m + 1] > own_.first[m];
    sums_.plan(
        cells, system.comm(), [](const Cell& cell) { return cell.nodeCount(); }, isMine);
    findWeights(cells, layout, system.comm());
    own_.findTouched(layout, volume.size());
    others_.clear();
    normal_.clear();
    for (const Cell& cell : cells)
        for (const Vec3& area : membrane::volumeGradient(cell.membrane.position, cell.membrane.network().triangles()))
            normal_.push_back(area.stableNormalized());
}

void NodeFluidMap::findEntries(const Cells& cells, const ParticleSystem& system, const std::vector<double>& volume) {
    const particles::ParticleStore& s = system.store();
    const double reach = radius_ + 0.5 * system.skin();  // particles are found by their places when lists were built
    own_.clear();
    for (const Cell& cell : cells)
        for (const Vec3& x : cell.membrane.position) {
            forImages(system, x, reach, [&](const Vec3& image) {
                system.forOwnedNear(image, reach, [&](int i) {
                    const Vec3 q = (s.position(static_cast<std::size_t>(i)) - image) / radius_;
                    const double r2 = q.squaredNorm();
                    if (r2 < 1)
                        own_.entries.push_back(
                            {i, volume[static_cast<std::size_t>(i)] * wendland(std::sqrt(r2)), 0, q});
                });
            });
            own_.first.push_back(own_.entries.size());
        }
}

void NodeFluidMap::findWeights(const Cells& cells, const NodeLayout& layout, MPI_Comm comm) {
    const std::size_t nodes = layout.nodes();
    std::vector<double> sums(moments * nodes, 0.0);
    for (std::size_t m = 0; m < nodes; ++m)
        for (std::size_t k = own_.first[m]; k < own_.first[m + 1]; ++k) {
            const Polynomial of = basis(own_.entries[k].q);
            double* sum = &sums[moments * m];
            for (int a = 0; a < of.size(); ++a)
                for (int b = a; b < of.size(); ++b) *sum++ += own_.entries[k].along * of[a] * of[b];
            *sum += 1;
        }
    sums_.addUp(sums, moments);
    along_.assign(nodes, Polynomial::Zero()), extra_.assign(nodes, Polynomial::Zero());
    std::vector<double> absolute(2 * nodes, 0.0);  // sum |w|, sum |w'|
    for (std::size_t m = 0; m < nodes; ++m) {
        const double* sum = &sums[moments * m];
        Eigen::Matrix<double, 5, 5> A;
        for (int a = 0; a < A.rows(); ++a)
            for (int b = a; b < A.cols(); ++b) A(a, b) = A(b, a) = *sum++;
        if (*sum < fewest) {
            absolute[2 * m] = std::numeric_limits<double>::infinity();
            continue;
        }
        const auto factors = A.ldlt();
        along_[m] = factors.solve(Polynomial(1, 0, 0, 0, momentAlong));
        extra_[m] = factors.solve(Polynomial(0, 0, 0, 0, momentAcross - momentAlong));
        for (std::size_t k = own_.first[m]; k < own_.first[m + 1]; ++k) {
            const Entry& e = own_.entries[k];
            const double w = e.along * along_[m].dot(basis(e.q));
            absolute[2 * m] += std::abs(w);
            absolute[2 * m + 1] += std::abs(w + e.along * extra_[m].dot(basis(e.q)));
        }
    }
    sums_.addUp(absolute, 2);
    const Communicator ranks(comm);
    long fallbacks = 0, dry = 0;
    std::string fault;
    for (std::size_t c = 0; c < layout.cells(); ++c)
        for (std::size_t m = layout.first(c); m < layout.last(c); ++m) {
            const double all = sums[moments * m];
            if (!(all > 0) && dry++ == 0)
                fault = fmt::format("node {} of the membrane '{}' has no fluid within {} m: the run has diverged",
                                    m - layout.first(c), cells[c].membrane.name, radius_);
            if (!(absolute[2 * m] <= largestWeights && absolute[2 * m + 1] <= largestWeights)) {
                along_[m] = Polynomial(1 / all, 0, 0, 0, 0), extra_[m] = Polynomial::Zero();
                fallbacks += cells[c].isOwnedBy(ranks.rank()) ? 1 : 0;
            }
            for (std::size_t k = own_.first[m]; k < own_.first[m + 1]; ++k) {
                Entry& e = own_.entries[k];
                const Polynomial of = basis(e.q);
                e.extra = e.along * extra_[m].dot(of);
                e.along *= along_[m].dot(of);
            }
        }
    const std::vector<long> counts = ranks.sum(std::vector<long>{fallbacks, dry});
    if (counts[1] > 0) throwTogether(comm, dry > 0, fault, ExitCode::numerics);
    fallbacks_ = counts[0];
    mostFallbacks_ = std::max(mostFallbacks_, fallbacks_);
}

void NodeFluidMap::Weights::findTouched(const NodeLayout& layout, std::size_t particles) {
    std::vector<std::size_t> lastSeen(particles, 0);  // by which cell, 1 and up
    touched.clear();
    touchedBy.assign(layout.cells(), {});
    for (std::size_t c = 0; c < layout.cells(); ++c)
        for (std::size_t k = first[layout.first(c)]; k < first[layout.last(c)]; ++k) {
            const int i = entries[k].particle;
            const std::size_t before = std::exchange(lastSeen[static_cast<std::size_t>(i)], c + 1);
            if (before == 0) touched.push_back(i);
            if (before != c + 1) touchedBy[c].push_back(i);
        }
}

void NodeFluidMap::placeOthers(const Cells& cells, const NodeLayout& layout, ParticleSystem& system,
                               const particles::SharedParticles& shared, const std::vector<double>& volume) {
    const std::size_t own = shared.owned();
    particles::RealArray records(4 * (own + static_cast<std::size_t>(system.ghosts())));
    for (std::size_t i = 0; i < own; ++i) {
        Vec3::Map(records.data() + 4 * i) = system.store().position(i);
        records[4 * i + 3] = volume[i];
    }
    system.halo().exchange(records.data(), system.owned(), 4);
    const double reach = radius_ + 0.5 * system.skin(), ofHalo = system.support() + system.skin();
    others_.clear();
    for (const Cell& cell : cells)
        for (const Vec3& x : cell.membrane.position) {
            const std::size_t m = others_.first.size() - 1;
            forImages(system, x, reach + ofHalo, [&](const Vec3& image) {
                system.forGhostsNear(image, reach, [&](int ghost) {
                    const std::size_t entry = shared.entry(ghost);
                    if (entry < own || shared.ghostOf()[entry - own] != ghost) return;
                    const double* record = records.data() + 4 * (own + static_cast<std::size_t>(ghost));
                    const Vec3 q = (Vec3::Map(record) - image) / radius_;
                    if (q.squaredNorm() >= 1) return;
                    const double weight = record[3] * wendland(q.norm());
                    const Polynomial of = basis(q);
                    others_.entries.push_back(
                        {static_cast<int>(entry), weight * along_[m].dot(of), weight * extra_[m].dot(of), q});
                });
            });
            others_.first.push_back(others_.entries.size());
        }
    others_.findTouched(layout, shared.entries());
}

template <class Real>
NodeVectors NodeFluidMap::interpolate(const Real* u) {
    NodeVectors v(normal_.size(), Vec3::Zero());
    for (std::size_t m = 0; m < v.size(); ++m) {
        const Vec3& n = normal_[m];
        double across = 0;
        for (std::size_t k = own_.first[m]; k < own_.first[m + 1]; ++k) {
            const Entry& e = own_.entries[k];
            const Real* of = u + 4 * static_cast<std::size_t>(e.particle);
            const Vec3 here(of[0], of[1], of[2]);
            v[m] += e.along * here;
            across += e.extra * n.dot(here);
        }
        v[m] += across * n;
    }
    sums_.addUp({reinterpret_cast<double*>(v.data()), 3 * v.size()}, 3);
    return v;
}
template NodeVectors NodeFluidMap::interpolate(const double*);
template NodeVectors NodeFluidMap::interpolate(const float*);

void NodeFluidMap::spreadBy(const Weights& weights, const NodeVectors& f, particles::RealArray& force) const {
    for (std::size_t m = 0; m + 1 < weights.first.size(); ++m) {
        const Vec3 across = normal_[m].dot(f[m]) * normal_[m];
        for (std::size_t k = weights.first[m]; k < weights.first[m + 1]; ++k) {
            const Entry& e = weights.entries[k];
            double* to = force.data() + 4 * static_cast<std::size_t>(e.particle);
            for (int a = 0; a < 3; ++a) to[a] += e.along * f[m][a] + e.extra * across[a];
        }
    }
}

}  // namespace corpuscle::coupling
