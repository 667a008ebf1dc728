#include "coupling/dualIdentity.hpp"

#include <algorithm>
#include <cmath>

#include "core/communicator.hpp"
#include "core/powerIteration.hpp"

namespace corpuscle::coupling {

using particles::ParticleSystem;
using Vectors = std::vector<Vec3>;

namespace {

Vectors none(const Vectors& like) { return Vectors(like.size(), Vec3::Zero()); }

// Largest eigenvalue of M^-1 K on the nodes of a cell, by power iterations. stiffness(mode) = K mode, for modes whose
// longest node vector has the length 1.
template <class F>
double largestEigenvalue(const Cell& cell, int iterations, F&& stiffness) {
    Vectors mode(cell.nodeMass.size());
    for (std::size_t k = 0; k < mode.size(); ++k)  // a vector that is unlikely to have a symmetry of the mesh
        mode[k] = Vec3(std::sin(1 + 12.9898 * static_cast<double>(k)), std::sin(2 + 78.233 * static_cast<double>(k)),
                       std::sin(3 + 37.719 * static_cast<double>(k)));
    const auto square = [&] {
        double sum = 0;
        for (std::size_t k = 0; k < mode.size(); ++k) sum += cell.nodeMass[k] * mode[k].squaredNorm();
        return sum;
    };
    const auto normalise = [&] {
        double longest = 0;
        for (const Vec3& v : mode) longest = std::max(longest, v.norm());
        if (longest == 0) return 0.0;
        for (Vec3& v : mode) v /= longest;
        return square();
    };
    return corpuscle::largestEigenvalue(iterations, normalise, [&] {
        const Vectors& image = stiffness(mode);
        for (std::size_t k = 0; k < mode.size(); ++k) mode[k] = image[k] / cell.nodeMass[k];
        return square();
    });
}

}  // namespace

DualIdentity::DualIdentity(Cells& cells, double spacing, const DensityBalance& balance, Intervals intervals)
    : cells_(cells), guard_(spacing), balance_(balance), intervals_(intervals) {}

void DualIdentity::moved(ParticleSystem& system, double extrapolation, bool rebuilt) {
    if (rebuilt) exchange_.plan(system, cells_);
    exchange_.gather(system, cells_, extrapolation);
    if (rebuilt) guard_.findCandidates(system, cells_);
}

void DualIdentity::addAccelerations(ParticleSystem& system) {
    for (Cell& cell : cells_) cell.membrane.computeForces();
    auto& s = system.store();
    for (const NodeExchange::OwnedNode& n : exchange_.owned()) {
        const Vec3 a = cells_[static_cast<std::size_t>(n.cell)].membrane.force[static_cast<std::size_t>(n.node)] /
                       s.mass[n.particle];
        s.fx[n.particle] += a[0];
        s.fy[n.particle] += a[1];
        s.fz[n.particle] += a[2];
    }
}

void DualIdentity::addRates(const ParticleSystem&, const sph::FluidForces& forces, sph::Budget::Values& rates) const {
    std::vector<Vectors> viscous(cells_.heldCount());
    for (std::size_t c = 0; c < cells_.heldCount(); ++c) {
        const membrane::Membrane& m = cells_[c].membrane;
        if (!m.isViscous()) continue;
        viscous[c] = none(m.position);
        m.addViscousForces(m.velocity, viscous[c]);
    }
    double all = 0, byViscosity = 0;
    for (const NodeExchange::OwnedNode& n : exchange_.owned()) {
        const auto c = static_cast<std::size_t>(n.cell), node = static_cast<std::size_t>(n.node);
        const Vec3 u = forces.velocityUsed(static_cast<std::size_t>(n.particle));
        all += u.dot(cells_[c].membrane.force[node]);
        if (!viscous[c].empty()) byViscosity += u.dot(viscous[c][node]);
    }
    rates[sph::Budget::kinetic] += all;
    rates[sph::Budget::elastic] -= all - byViscosity;
    rates[sph::Budget::inMembranes] -= byViscosity;
}

std::vector<RuptureEvent> DualIdentity::endStep(ParticleSystem& system, double dt, sph::Budget* budget) {
    ++steps_;
    std::vector<RuptureEvent> events;
    for (std::size_t c = 0; c < cells_.heldCount(); ++c) {
        membrane::Membrane& membrane = cells_[c].membrane;
        if (!membrane.canRupture()) continue;
        const bool counts =
            budget && std::any_of(exchange_.owned().begin(), exchange_.owned().end(),
                                  [&](const auto& n) { return static_cast<std::size_t>(n.cell) == c && n.node == 0; });
        RuptureEvent event = rupture(membrane, dt, counts ? budget : nullptr, [&] {
            if (intervals_.guard > 0) guard_.movedBack(system, cells_[c], c);
        });
        if (!event.bonds.empty()) events.push_back(std::move(event));
    }
    const auto due = [&](long interval) { return interval > 0 && steps_ % interval == 0; };
    if (due(intervals_.guard)) guard_.movedBack(system, cells_);
    if (due(intervals_.densityBalance)) balance_.apply(system, cells_);
    return events;
}

double DualIdentity::springRate2(const ParticleSystem& system, int iterations) const {
    double largest = 0;
    for (const Cell& cell : cells_) {
        const membrane::Membrane& m = cell.membrane;
        const double step = 1e-4 * m.network().meanBondLength();
        Vectors x = m.position, restForce = none(x), f = restForce;
        m.addElasticForces(x, restForce);
        largest = std::max(largest, largestEigenvalue(cell, iterations, [&](const Vectors& mode) -> const Vectors& {
                               for (std::size_t k = 0; k < x.size(); ++k) x[k] = m.position[k] + step * mode[k];
                               std::fill(f.begin(), f.end(), Vec3::Zero());
                               m.addElasticForces(x, f);
                               for (std::size_t k = 0; k < f.size(); ++k) f[k] = (restForce[k] - f[k]) / step;
                               return f;
                           }));
    }
    return Communicator(system.comm()).max(largest);
}

double DualIdentity::membraneRate(const ParticleSystem& system, int iterations) const {
    double largest = 0;
    for (const Cell& cell : cells_) {
        if (!cell.membrane.isViscous()) continue;
        Vectors f = none(cell.membrane.position);
        largest = std::max(largest, largestEigenvalue(cell, iterations, [&](const Vectors& mode) -> const Vectors& {
                               std::fill(f.begin(), f.end(), Vec3::Zero());
                               cell.membrane.addViscousForces(mode, f);
                               for (Vec3& force : f) force = -force;
                               return f;
                           }));
    }
    return Communicator(system.comm()).max(largest);
}

}  // namespace corpuscle::coupling
