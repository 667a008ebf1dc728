#include "coupling/dualIdentity.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle::coupling {

using particles::ParticleSystem;

DualIdentity::DualIdentity(std::vector<Cell>& cells, double spacing, const DensityBalance& balance, Intervals intervals)
    : cells_(cells),
      guard_(spacing),
      balance_(balance),
      margin_(LeakageGuard::reachInSpacings * spacing),
      intervals_(intervals) {}

void DualIdentity::moved(ParticleSystem& system, bool rebuilt) {
    if (rebuilt) exchange_.plan(system, cells_, margin_ + system.skin());
    exchange_.gather(system, cells_);
    if (rebuilt) guard_.findCandidates(system, cells_);
}

void DualIdentity::addAccelerations(ParticleSystem& system) {
    for (Cell& cell : cells_)
        if (cell.held) cell.membrane.computeForces();
    auto& s = system.store();
    for (const NodeExchange::OwnedNode& n : exchange_.owned()) {
        const Vec3 a = cells_[static_cast<std::size_t>(n.cell)].membrane.force[static_cast<std::size_t>(n.node)] /
                       s.mass[n.particle];
        s.fx[n.particle] += a[0];
        s.fy[n.particle] += a[1];
        s.fz[n.particle] += a[2];
    }
}

std::vector<RuptureEvent> DualIdentity::endStep(ParticleSystem& system, double dt) {
    ++steps_;
    std::vector<RuptureEvent> events;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
        membrane::Membrane& membrane = cells_[c].membrane;
        if (!cells_[c].held || !membrane.canRupture()) continue;
        std::vector<membrane::BrokenBond> broken = membrane.findBroken(dt);
        if (broken.empty()) continue;
        if (intervals_.guard > 0) guard_.putBack(system, cells_[c], c);
        membrane.breakBonds(broken);
        events.push_back({membrane.cell, std::move(broken)});
    }
    const auto due = [&](long interval) { return interval > 0 && steps_ % interval == 0; };
    if (due(intervals_.guard)) guard_.putBack(system, cells_);
    if (due(intervals_.densityBalance)) balance_.apply(system, cells_);
    return events;
}

double DualIdentity::springRate2(const ParticleSystem& system, int iterations) {
    double largest = 0;
    for (Cell& cell : cells_) {
        if (!cell.held) continue;
        membrane::Membrane& m = cell.membrane;
        const std::vector<Vec3> rest = m.position, restForce = [&] { return m.computeForces(), m.force; }();
        const double step = 1e-4 * m.network().meanBondLength();
        std::vector<Vec3> mode(rest.size());
        for (std::size_t k = 0; k < mode.size(); ++k)  // any vector that no symmetry of the mesh is likely to share
            mode[k] =
                Vec3(std::sin(1 + 12.9898 * static_cast<double>(k)), std::sin(2 + 78.233 * static_cast<double>(k)),
                     std::sin(3 + 37.719 * static_cast<double>(k)));
        double rate2 = 0;
        for (int it = 0; it < iterations; ++it) {
            double longest = 0;
            for (const Vec3& v : mode) longest = std::max(longest, v.norm());
            if (longest == 0) break;
            for (std::size_t k = 0; k < mode.size(); ++k) m.position[k] = rest[k] + step / longest * mode[k];
            m.computeForces();
            double before = 0, after = 0;
            for (std::size_t k = 0; k < mode.size(); ++k) {
                const Vec3 image = (restForce[k] - m.force[k]) / (step * cell.nodeMass[k]);
                before += cell.nodeMass[k] * (mode[k] / longest).squaredNorm();
                after += cell.nodeMass[k] * image.squaredNorm();
                mode[k] = image;
            }
            rate2 = std::sqrt(after / before);
        }
        m.position = rest;
        m.force = restForce;
        largest = std::max(largest, rate2);
    }
    MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, system.comm());
    return largest;
}

}  // namespace corpuscle::coupling
