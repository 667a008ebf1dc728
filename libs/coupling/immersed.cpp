#include "coupling/immersed.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/communicator.hpp"
#include "core/error.hpp"
#include "membrane/surface.hpp"

namespace corpuscle::coupling {

using particles::ParticleSystem;

namespace {

constexpr int fewest = 10;  // particles for more than Shepard's weights

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

Immersed::Immersed(std::vector<Cell>& cells, double spacing) : cells_(cells), radius_(radiusInSpacings * spacing) {
    for (const Cell& cell : cells_) {
        nodes_ += static_cast<std::size_t>(cell.nodeCount());
        stiffness_.emplace_back(static_cast<std::size_t>(cell.nodeCount()));
        damping_.emplace_back(static_cast<std::size_t>(cell.membrane.isViscous() ? cell.nodeCount() : 0));
    }
}

template <class F>
void Immersed::forCells(F&& f) const {
    for (std::size_t c = 0; c < cells_.size(); ++c) {
        const auto first = static_cast<std::size_t>(cells_[c].firstNode);
        f(c, first, first + static_cast<std::size_t>(cells_[c].nodeCount()));
    }
}

void Immersed::move(double seconds) {
    for (Cell& cell : cells_)
        for (std::size_t n = 0; n < cell.membrane.position.size(); ++n)
            cell.membrane.position[n] += seconds * cell.membrane.velocity[n];
}

Immersed::Vectors Immersed::velocities() const {
    Vectors all;
    for (const Cell& cell : cells_) all.insert(all.end(), cell.membrane.velocity.begin(), cell.membrane.velocity.end());
    return all;
}

void Immersed::setVelocities(const Vectors& velocities) {
    forCells([&](std::size_t c, std::size_t first, std::size_t last) {
        cells_[c].membrane.velocity.assign(velocities.begin() + static_cast<std::ptrdiff_t>(first),
                                           velocities.begin() + static_cast<std::ptrdiff_t>(last));
    });
}

void Immersed::restoreVolume() {
    for (Cell& cell : cells_) {
        membrane::Membrane& m = cell.membrane;
        if (m.network().isOpen()) continue;
        const Vectors g = membrane::volumeGradient(m.position, m.network().triangles());
        double square = 0;
        for (const Vec3& a : g) square += a.squaredNorm();
        const double missing = cell.initialVolume - m.volume();
        for (std::size_t n = 0; n < g.size(); ++n) m.position[n] += missing / square * g[n];
    }
}

void Immersed::place(const ParticleSystem& system, const std::vector<double>& volume) {
    comm_ = system.comm();
    findEntries(system, volume);
    findWeights();
    own_.findTouched(volume.size());
    others_.clear();
    gradient_.assign(nodes_, Vec3::Zero());
    normal_.assign(nodes_, Vec3::Zero());
    forCells([&](std::size_t c, std::size_t first, std::size_t) {
        membrane::Membrane& m = cells_[c].membrane;
        m.force.assign(m.force.size(), Vec3::Zero());
        m.addElasticForces(m.position, m.force);
        const Vectors g = membrane::volumeGradient(m.position, m.network().triangles());
        std::transform(g.begin(), g.end(), normal_.begin() + static_cast<std::ptrdiff_t>(first),
                       [](const Vec3& area) { return area.stableNormalized(); });
        if (m.network().isOpen()) return;
        std::copy(g.begin(), g.end(), gradient_.begin() + static_cast<std::ptrdiff_t>(first));
    });
}

void Immersed::build(const ParticleSystem& system, const std::vector<double>& volume) {
    place(system, volume);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
        const membrane::Membrane& m = cells_[c].membrane;
        stiffness_[c].clear();
        m.addStiffness(membrane::Definiteness::partwise, stiffness_[c]);
        damping_[c].clear();
        m.addDamping(damping_[c]);
    }
}

void Immersed::findEntries(const ParticleSystem& system, const std::vector<double>& volume) {
    const particles::ParticleStore& s = system.store();
    const double reach = radius_ + 0.5 * system.skin();  // particles are found by their places when lists were built
    own_.clear();
    for (const Cell& cell : cells_)
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

void Immersed::findWeights() {
    constexpr std::size_t moments = 16;  // upper triangle of sum W b b^T with the basis b, and how many
    std::vector<double> sums(moments * nodes_, 0.0);
    for (std::size_t m = 0; m < nodes_; ++m)
        for (std::size_t k = own_.first[m]; k < own_.first[m + 1]; ++k) {
            const Polynomial of = basis(own_.entries[k].q);
            double* sum = &sums[moments * m];
            for (int a = 0; a < of.size(); ++a)
                for (int b = a; b < of.size(); ++b) *sum++ += own_.entries[k].along * of[a] * of[b];
            *sum += 1;
        }
    Communicator(comm_).addUp(sums);
    along_.assign(nodes_, Polynomial::Zero()), extra_.assign(nodes_, Polynomial::Zero());
    std::vector<double> absolute(2 * nodes_, 0.0);  // sum |w|, sum |w'|
    for (std::size_t m = 0; m < nodes_; ++m) {
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
    Communicator(comm_).addUp(absolute);
    fallbacks_ = 0;
    for (std::size_t m = 0; m < nodes_; ++m) {
        const double all = sums[moments * m];
        if (!(all > 0))
            throw Failure(ExitCode::numerics, "node " + std::to_string(m) +
                                                  " of the membranes, counted through all cells, has no fluid within " +
                                                  std::to_string(radius_) + " m: the run has diverged");
        if (!(absolute[2 * m] <= largestWeights && absolute[2 * m + 1] <= largestWeights)) {
            along_[m] = Polynomial(1 / all, 0, 0, 0, 0), extra_[m] = Polynomial::Zero();
            ++fallbacks_;
        }
        for (std::size_t k = own_.first[m]; k < own_.first[m + 1]; ++k) {
            Entry& e = own_.entries[k];
            const Polynomial of = basis(e.q);
            e.extra = e.along * extra_[m].dot(of);
            e.along *= along_[m].dot(of);
        }
    }
    mostFallbacks_ = std::max(mostFallbacks_, fallbacks_);
}

void Immersed::Weights::findTouched(std::size_t particles) {
    std::vector<char> seen(particles, 0);
    touched.clear();
    for (const Entry& e : entries)
        if (!std::exchange(seen[static_cast<std::size_t>(e.particle)], char(1))) touched.push_back(e.particle);
}

void Immersed::placeOthers(ParticleSystem& system, const particles::SharedParticles& shared,
                           const std::vector<double>& volume) {
    const std::size_t own = shared.owned();
    particles::RealArray records(4 * (own + static_cast<std::size_t>(system.ghosts())));
    for (std::size_t i = 0; i < own; ++i) {
        Vec3::Map(records.data() + 4 * i) = system.store().position(i);
        records[4 * i + 3] = volume[i];
    }
    system.halo().exchange(records.data(), system.owned(), 4);
    const double reach = radius_ + 0.5 * system.skin(), ofHalo = system.support() + system.skin();
    others_.clear();
    for (const Cell& cell : cells_)
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
    others_.findTouched(shared.entries());
}

void Immersed::project(Vectors& v) const {
    forCells([&](std::size_t, std::size_t first, std::size_t last) {
        double dot = 0, square = 0;
        for (std::size_t n = first; n < last; ++n) dot += gradient_[n].dot(v[n]), square += gradient_[n].squaredNorm();
        if (square == 0) return;
        for (std::size_t n = first; n < last; ++n) v[n] -= dot / square * gradient_[n];
    });
}

template <class Real>
Immersed::Vectors Immersed::interpolate(const Real* u) const {
    Vectors v(nodes_, Vec3::Zero());
    for (std::size_t m = 0; m < nodes_; ++m) {
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
    Communicator(comm_).addUp({v.front().data(), 3 * nodes_});
    project(v);
    return v;
}
template Immersed::Vectors Immersed::interpolate(const double*) const;
template Immersed::Vectors Immersed::interpolate(const float*) const;

Immersed::Vectors Immersed::force() const {
    Vectors all;
    for (const Cell& cell : cells_) all.insert(all.end(), cell.membrane.force.begin(), cell.membrane.force.end());
    return all;
}

void Immersed::addStiffness(double factor, const Vectors& u, Vectors& f) const {
    forCells([&](std::size_t c, std::size_t first, std::size_t last) {
        stiffness_[c].addProduct(factor, {u.data() + first, last - first}, {f.data() + first, last - first});
    });
}

void Immersed::addResistance(double time, const Vectors& u, Vectors& f) const {
    addStiffness(-time, u, f);
    addDamping(u, f);
}

void Immersed::addDamping(const Vectors& u, Vectors& f) const {
    forCells([&](std::size_t c, std::size_t first, std::size_t last) {
        if (cells_[c].membrane.isViscous())
            damping_[c].addProduct(-1, {u.data() + first, last - first}, {f.data() + first, last - first});
    });
}

double Immersed::meanResistance(double time) const {
    double trace = 0;
    forCells([&](std::size_t c, std::size_t first, std::size_t last) {
        for (std::size_t m = 0; m < last - first; ++m) {
            trace += time * stiffness_[c].diagonal(m).trace();
            if (cells_[c].membrane.isViscous()) trace += damping_[c].diagonal(m).trace();
        }
    });
    return trace / (3.0 * static_cast<double>(nodes_));
}

bool Immersed::isViscous() const {
    return std::any_of(cells_.begin(), cells_.end(), [](const Cell& cell) { return cell.membrane.isViscous(); });
}

void Immersed::addViscousForces(const Vectors& u, Vectors& f) const {
    forCells([&](std::size_t c, std::size_t first, std::size_t last) {
        if (cells_[c].membrane.isViscous())
            cells_[c].membrane.addViscousForces({u.data() + first, last - first}, {f.data() + first, last - first});
    });
}

Immersed::Vectors Immersed::forceAt(const Vectors& displacement) const {
    Vectors f(nodes_, Vec3::Zero());
    forCells([&](std::size_t c, std::size_t first, std::size_t last) {
        Vectors x = cells_[c].membrane.position;
        for (std::size_t n = first; n < last; ++n) x[n - first] += displacement[n];
        cells_[c].membrane.addElasticForces(x, {f.data() + first, last - first});
    });
    return f;
}

void Immersed::spread(Vectors f, particles::RealArray& force) const {
    project(f);
    spreadBy(own_, f, force);
}

void Immersed::spreadToOthers(Vectors f, particles::RealArray& force) const {
    project(f);
    spreadBy(others_, f, force);
}

void Immersed::spreadBy(const Weights& weights, const Vectors& f, particles::RealArray& force) const {
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
