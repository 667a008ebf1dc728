#include "coupling/dualIdentity.hpp"

#include <algorithm>
#include <limits>

namespace corpuscle::coupling {

using particles::ParticleSystem;

DualIdentity::DualIdentity(std::vector<Cell>& cells, double spacing, long guardSteps)
    : cells_(cells), guard_(spacing), margin_(LeakageGuard::reachInSpacings * spacing), guardSteps_(guardSteps) {}

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
        const Vec3 a = cells_[static_cast<std::size_t>(n.cell)].membrane.force[static_cast<std::size_t>(n.node)] / s.mass[n.particle];
        s.fx[n.particle] += a[0];
        s.fy[n.particle] += a[1];
        s.fz[n.particle] += a[2];
    }
}

std::vector<RuptureEvent> DualIdentity::endStep(ParticleSystem& system) {
    ++steps_;
    std::vector<RuptureEvent> events;
    for (Cell& cell : cells_)
        if (cell.held && cell.membrane.canRupture()) {
            std::vector<membrane::BrokenBond> broken = cell.membrane.applyRupture();
            if (!broken.empty()) events.push_back({cell.membrane.cell, std::move(broken)});
        }
    if (guardSteps_ > 0 && steps_ % guardSteps_ == 0) guard_.putBack(system, cells_);
    return events;
}

DualIdentity::Stiffest DualIdentity::stiffest(const ParticleSystem& system) const {
    double values[2] = {0, -std::numeric_limits<double>::infinity()};
    for (const Cell& cell : cells_)
        if (cell.held) values[0] = std::max(values[0], cell.membrane.maxStiffness());
    for (const NodeExchange::OwnedNode& n : exchange_.owned()) values[1] = std::max(values[1], -system.store().mass[n.particle]);
    MPI_Allreduce(MPI_IN_PLACE, values, 2, MPI_DOUBLE, MPI_MAX, system.comm());
    return {values[0], -values[1]};
}

}  // namespace corpuscle::coupling
