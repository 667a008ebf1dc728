#include "coupling/nodeFluidMap.hpp"

#include <fmt/core.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/communicator.hpp"
#include "core/together.hpp"
#include "coupling/nodeImages.hpp"
#include "membrane/surface.hpp"

namespace corpuscle::coupling {

using particles::ParticleSystem;

namespace {

constexpr int fewest = NodeBasis::size;  // with fewer particles there are no weights but those of the plain mean
// Sums of each node: the upper triangle of sum V W b b^T, and the number of particles.
constexpr std::size_t moments = NodeBasis::size * (NodeBasis::size + 1) / 2 + 1;

using Quad = Eigen::Array4d;  // the four numbers of a particle; of a vector, its three components and 0
Quad quadOf(const Vec3& v) { return {v[0], v[1], v[2], 0}; }
Vec3 vectorOf(const Quad& quad) { return quad.head<3>(); }

}  // namespace

void NodeFluidMap::place(const Cells& cells, const NodeLayout& layout, const ParticleSystem& system,
                         const std::vector<double>& volume) {
    findNormals(cells);
    smoothing_.place(cells, layout, normal_);
    for (Vec3& area : normal_) area.stableNormalize();
    findNear(cells, system, volume);
    std::vector<char> isMine(layout.nodes());
    for (std::size_t m = 0; m < isMine.size(); ++m) isMine[m] = firstNear_[m + 1] > firstNear_[m];
    sums_.plan(
        cells, system.comm(), [](const Cell& cell) { return cell.nodeCount(); }, smoothing_.reached(isMine));
    findCoefficients(cells, layout, system.comm());
    own_.clear(), others_.clear();
    for (std::size_t m = 0; m < layout.nodes(); ++m) {
        for (std::size_t k = firstNear_[m]; k < firstNear_[m + 1]; ++k) add(near_[k], m, own_);
        own_.first.push_back(own_.entries.size());
    }
    own_.findTouched(layout, volume.size());
    if (system.periodicity().slides()) findSlides(system.periodicity(), system.store(), cells);
}

// Interpolates the velocities of images beside the nodes, less those of their particles.
void NodeFluidMap::findSlides(const Periodicity& period, const particles::ParticleStore& s, const Cells& cells) {
    std::vector<Vec3> slide(own_.entries.size());
    std::size_t m = 0;
    for (const Cell& cell : cells)
        for (const Vec3& x : cell.membrane.position) {
            for (std::size_t k = own_.first[m]; k < own_.first[m + 1]; ++k) {
                const Vec3 at = s.position(static_cast<std::size_t>(near_[k].particle));
                slide[k] = period.slideOf(at, x + radius_ * near_[k].q);
            }
            ++m;
        }
    slides_ = interpolateBy([&](std::size_t k) { return quadOf(slide[k]); });
}

void NodeFluidMap::findNormals(const Cells& cells) {
    normal_.clear();
    for (const Cell& cell : cells) {
        const auto areas = membrane::volumeGradient(cell.membrane.position, cell.membrane.network().triangles());
        normal_.insert(normal_.end(), areas.begin(), areas.end());
    }
}

void NodeFluidMap::findNear(const Cells& cells, const ParticleSystem& system, const std::vector<double>& volume) {
    const particles::ParticleStore& s = system.store();
    const double reach = radius_ + 0.5 * system.skin();  // the search uses positions at the time of the last list build
    firstNear_.assign(1, 0), near_.clear();
    for (const Cell& cell : cells)
        for (const Vec3& x : cell.membrane.position) {
            forImages(system, x, reach, [&](const Vec3& image) {
                system.forOwnedNear(image, reach, [&](int i) {
                    const Vec3 q = (s.position(static_cast<std::size_t>(i)) - image) / radius_;
                    const double r2 = q.squaredNorm();
                    if (r2 < 1)
                        near_.push_back({i, volume[static_cast<std::size_t>(i)] * NodeBasis::weight(std::sqrt(r2)), q});
                });
            });
            firstNear_.push_back(near_.size());
        }
}

bool NodeFluidMap::hasSlopes() const {
    return std::any_of(conditions_.begin(), conditions_.end(), [](const NodeConditions& c) { return c.slope != 0; });
}

void NodeFluidMap::Coefficients::mix(double share, const NodeBasis::Vector& mean) {
    if (share == 1) {  // the others may not be finite
        *this = {mean, mean, NodeBasis::Vector::Zero(), decltype(slope)::Zero()};
        return;
    }
    along += share * (mean - along), across += share * (mean - across);
    shift *= 1 - share, slope *= 1 - share;
}

// Coefficients from the sums over all particles near the node.
NodeFluidMap::Coefficients NodeFluidMap::solve(const Cell& cell, std::size_t m, const double* sums) const {
    NodeBasis::Matrix A;
    for (int a = 0; a < NodeBasis::size; ++a)
        for (int b = a; b < NodeBasis::size; ++b) A(a, b) = A(b, a) = *sums++;
    const auto factors = A.ldlt();
    const NodeConditions& conditions = conditions_[cell.type];
    const double square = smoothing_.square(m) / (radius_ * radius_);
    const NodeBasis::Vector ofAlong = NodeBasis::conditions(conditions.kink, squareAlong - square);
    Coefficients c{factors.solve(ofAlong),
                   factors.solve(NodeBasis::conditions(kinkAcross, squareAcross - square)),
                   NodeBasis::Vector::Zero(),
                   {}};
    for (int k = 0; k < 3; ++k) c.slope.col(k) = factors.solve(NodeBasis::derivative(k)) / radius_;
    // Of a singular matrix, as of few particles in a symmetric arrangement, the factors may give finite numbers.
    if (!((A * c.along - ofAlong).norm() < 1e-6)) c.along.setConstant(std::numeric_limits<double>::quiet_NaN());
    c.shift = c.slope * smoothing_.shift(m);
    c.slope *= conditions.slope * support_;
    return c;
}

void NodeFluidMap::findCoefficients(const Cells& cells, const NodeLayout& layout, MPI_Comm comm) {
    const std::size_t nodes = layout.nodes();
    std::vector<double> sums(moments * nodes, 0.0);
    for (std::size_t m = 0; m < nodes; ++m)
        for (std::size_t k = firstNear_[m]; k < firstNear_[m + 1]; ++k) {
            const NodeBasis::Vector of = NodeBasis::at(near_[k].q, normal_[m]);
            double* sum = &sums[moments * m];
            for (int a = 0; a < of.size(); ++a)
                for (int b = a; b < of.size(); ++b) *sum++ += near_[k].weight * of[a] * of[b];
            *sum += 1;
        }
    sums_.addUp(sums, moments);
    coefficients_.assign(nodes, {});
    std::vector<double> absolute(2 * nodes, 0.0);  // sum |w|, sum |w'|
    for (std::size_t c = 0; c < layout.cells(); ++c)
        for (std::size_t m = layout.first(c); m < layout.last(c); ++m) {
            const double* sum = &sums[moments * m];
            if (sum[moments - 1] < fewest) {
                absolute[2 * m] = std::numeric_limits<double>::infinity();
                continue;
            }
            coefficients_[m] = solve(cells[c], m, sum);
            for (std::size_t k = firstNear_[m]; k < firstNear_[m + 1]; ++k) {
                const NodeBasis::Vector of = NodeBasis::at(near_[k].q, normal_[m]);
                absolute[2 * m] += std::abs(near_[k].weight * coefficients_[m].along.dot(of));
                absolute[2 * m + 1] += std::abs(near_[k].weight * coefficients_[m].across.dot(of));
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
            const double share =
                std::max(NodeBasis::shareOfMean(absolute[2 * m]), NodeBasis::shareOfMean(absolute[2 * m + 1]));
            if (share == 0) continue;
            coefficients_[m].mix(share, NodeBasis::Vector::Unit(0) / all);
            fallbacks += cells[c].isOwnedBy(ranks.rank()) ? 1 : 0;
        }
    const std::vector<long> counts = ranks.sum(std::vector<long>{fallbacks, dry});
    if (counts[1] > 0) throwTogether(comm, dry > 0, fault, ExitCode::numerics);
    fallbacks_ = counts[0];
    mostFallbacks_ = std::max(mostFallbacks_, fallbacks_);
}

void NodeFluidMap::add(const Near& near, std::size_t m, Weights& weights) const {
    const NodeBasis::Vector of = near.weight * NodeBasis::at(near.q, normal_[m]);
    const Coefficients& c = coefficients_[m];
    const double along = c.along.dot(of);
    weights.entries.push_back({near.particle, along, c.across.dot(of) - along, c.shift.dot(of)});
    if (hasSlopes()) weights.slopes.push_back(c.slope.transpose() * of);
}

void NodeFluidMap::Weights::findTouched(const NodeLayout& layout, std::size_t particles) {
    std::vector<std::size_t> lastSeen(particles, 0);  // 1 + index of the last cell that touched each particle; 0: none
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

GhostRecords::GhostRecords(ParticleSystem& system, const particles::SharedParticles& shared,
                           const std::vector<double>& volume)
    : first_(4 * shared.owned()), records_(first_ + 4 * static_cast<std::size_t>(system.ghosts())) {
    for (std::size_t i = 0; i < shared.owned(); ++i) {
        Vec3::Map(records_.data() + 4 * i) = system.store().position(i);
        records_[4 * i + 3] = volume[i];
    }
    system.halo().exchange(records_.data(), system.owned(), 4);
}

void NodeFluidMap::placeOthers(const Cells& cells, const NodeLayout& layout, const ParticleSystem& system,
                               const particles::SharedParticles& shared, const GhostRecords& ghosts) {
    const std::size_t own = shared.owned();
    const double reach = radius_ + 0.5 * system.skin(), ofHalo = system.support() + system.skin();
    others_.clear();
    for (const Cell& cell : cells)
        for (const Vec3& x : cell.membrane.position) {
            const std::size_t m = others_.first.size() - 1;
            forImages(system, x, reach + ofHalo, [&](const Vec3& image) {
                system.forGhostsNear(image, reach, [&](int ghost) {
                    const std::size_t entry = shared.entry(ghost);
                    if (entry < own || shared.ghostOf()[entry - own] != ghost) return;
                    const Vec3 q = (ghosts.position(ghost) - image) / radius_;
                    if (q.squaredNorm() >= 1) return;
                    add({static_cast<int>(entry), ghosts.volume(ghost) * NodeBasis::weight(q.norm()), q}, m, others_);
                });
            });
            others_.first.push_back(others_.entries.size());
        }
    others_.findTouched(layout, shared.entries());
}

// All components are summed alike; then the normals are applied to the sums. With T = sum_j u_j g_j^T of the slopes g,
//     sum_j (n.g) [u - (n.u) n] + (n.u) [g - (n.g) n] = T n + T^T n - 2 (n.T n) n
// velocityOf(k): four numbers of the particle of entry k.
template <class VelocityOf>
NodeVectors NodeFluidMap::interpolateBy(VelocityOf&& velocityOf) {
    NodeVectors v(normal_.size()), shifts(smoothing_.isIdentity() ? 0 : v.size());
    for (std::size_t m = 0; m < v.size(); ++m) {
        const Vec3& n = normal_[m];
        Quad along = Quad::Zero(), extra = Quad::Zero(), shift = Quad::Zero();
        std::array<Quad, 3> slope{Quad::Zero(), Quad::Zero(), Quad::Zero()};
        for (std::size_t k = own_.first[m]; k < own_.first[m + 1]; ++k) {
            const Entry& e = own_.entries[k];
            const Quad here = velocityOf(k);
            along += e.along * here, extra += e.extra * here, shift += e.shift * here;
            if (!own_.slopes.empty())
                for (int a = 0; a < 3; ++a) slope[static_cast<std::size_t>(a)] += own_.slopes[k][a] * here;
        }
        v[m] = vectorOf(along) + n.dot(vectorOf(extra)) * n;
        if (!shifts.empty()) shifts[m] = vectorOf(shift);
        if (own_.slopes.empty()) continue;
        Mat3 T;
        for (int a = 0; a < 3; ++a) T.col(a) = vectorOf(slope[static_cast<std::size_t>(a)]);
        const Vec3 Tn = T * n;
        v[m] += Tn + T.transpose() * n - 2 * n.dot(Tn) * n;
    }
    smoothing_.apply(v);
    for (std::size_t m = 0; m < shifts.size(); ++m) v[m] += shifts[m];
    sums_.addUp({reinterpret_cast<double*>(v.data()), 3 * v.size()}, 3);
    return v;
}

template <class Real>
NodeVectors NodeFluidMap::interpolate(const Real* u) {
    return interpolateBy([&](std::size_t k) -> Quad {
        const auto i = static_cast<std::size_t>(own_.entries[k].particle);
        return Eigen::Map<const Eigen::Array<Real, 4, 1>>(u + 4 * i).template cast<double>();
    });
}
template NodeVectors NodeFluidMap::interpolate(const double*);
template NodeVectors NodeFluidMap::interpolate(const float*);

void NodeFluidMap::spreadBy(const Weights& weights, const NodeVectors& f, particles::RealArray& force) const {
    NodeVectors mean = f;
    smoothing_.transpose(mean);
    for (std::size_t m = 0; m + 1 < weights.first.size(); ++m) {
        const Vec3& n = normal_[m];
        const Vec3 across = n.dot(mean[m]) * n, along = mean[m] - across;
        const Quad all = quadOf(mean[m]), extra = quadOf(across), shift = quadOf(f[m]);
        std::array<Quad, 3> slope;  // columns of n along^T + along n^T
        for (int a = 0; a < 3; ++a) slope[static_cast<std::size_t>(a)] = quadOf(along[a] * n + n[a] * along);
        for (std::size_t k = weights.first[m]; k < weights.first[m + 1]; ++k) {
            const Entry& e = weights.entries[k];
            Quad sum = e.along * all + e.extra * extra + e.shift * shift;
            if (!weights.slopes.empty())
                for (int a = 0; a < 3; ++a) sum += weights.slopes[k][a] * slope[static_cast<std::size_t>(a)];
            Quad::Map(force.data() + 4 * static_cast<std::size_t>(e.particle)) += sum;
        }
    }
}

}  // namespace corpuscle::coupling
