#include "coupling/immersed.hpp"

#include <algorithm>
#include <map>

namespace corpuscle::coupling {

using particles::ParticleSystem;

namespace {

std::vector<NodeConditions> conditionsOf(const Cells& cells, const sph::FluidModel& model,
                                         const ParticleSystem& system) {
    std::map<double, NodeConditions> known;  // by the ratio of viscosities
    std::vector<NodeConditions> conditions;
    for (const CellType& type : cells.types()) {
        const auto [at, isNew] = known.try_emplace(type.viscosityRatio);
        if (isNew)
            at->second = FlatMembrane(*model.kernel, system.support() / system.spacing(),
                                      NodeFluidMap::radiusInSpacings, type.viscosityRatio)
                             .conditions();
        conditions.push_back(at->second);
    }
    return conditions;
}

}  // namespace

Immersed::Immersed(Cells& cells, const sph::FluidModel& model, const ParticleSystem& system)
    : cells_(cells), map_(system.spacing(), system.support(), conditionsOf(cells, model, system)), layout_(cells) {}

void Immersed::move(double seconds) {
    for (Cell& cell : cells_)
        for (std::size_t n = 0; n < cell.membrane.position.size(); ++n)
            cell.membrane.position[n] += seconds * cell.membrane.velocity[n];
}

void Immersed::depart(double seconds, bool onArc) {
    move(seconds);
    if (!onArc) return;
    for (Cell& cell : cells_) {
        membrane::Membrane& m = cell.membrane;
        cell.arc = Arc::of(m.position, m.velocity, seconds);
        for (Vec3& x : m.position) x = cell.arc.fromChord(x);
    }
}

void Immersed::takeBack(double seconds) {
    for (Cell& cell : cells_) {
        for (Vec3& x : cell.membrane.position) x = cell.arc.toChord(x);
        cell.arc = {};
    }
    move(-seconds);
}

Immersed::Vectors Immersed::velocities() const {
    Vectors all;
    for (const Cell& cell : cells_) all.insert(all.end(), cell.membrane.velocity.begin(), cell.membrane.velocity.end());
    return all;
}

void Immersed::setVelocities(const Vectors& velocities) {
    for (std::size_t c = 0; c < layout_.cells(); ++c) {
        const auto own = layout_.of(c, velocities);
        cells_[c].membrane.velocity.assign(own.begin(), own.end());
    }
}

void Immersed::place(const ParticleSystem& system, const std::vector<double>& volume) {
    comm_ = system.comm(), rank_ = system.decomposition().rank();
    cells_.follow(system);
    layout_ = NodeLayout(cells_);
    map_.place(cells_, layout_, system, volume);
    volume_.place(cells_, layout_);
    for (Cell& cell : cells_) {
        membrane::Membrane& m = cell.membrane;
        m.force.assign(m.force.size(), Vec3::Zero());
        m.addElasticForces(m.position, m.force);
    }
}

void Immersed::build(const ParticleSystem& system, const std::vector<double>& volume) {
    place(system, volume);
    stiffness_.build(cells_, layout_);
}

Immersed::Vectors Immersed::force() const {
    Vectors all;
    for (const Cell& cell : cells_) all.insert(all.end(), cell.membrane.force.begin(), cell.membrane.force.end());
    return all;
}

bool Immersed::isViscous() const {
    const auto& types = cells_.types();
    return std::any_of(types.begin(), types.end(),
                       [](const CellType& type) { return type.settings.viscosity.has_value(); });
}

void Immersed::spread(Vectors f, particles::RealArray& force) const {
    volume_.apply(f);
    map_.spread(f, force);
}

void Immersed::spreadToOthers(Vectors f, particles::RealArray& force) const {
    volume_.apply(f);
    map_.spreadToOthers(f, force);
}

}  // namespace corpuscle::coupling
