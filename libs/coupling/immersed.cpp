#include "coupling/immersed.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace corpuscle::coupling {

using particles::ParticleSystem;

namespace {

// Time ahead for which the lists of contact are made, over the time from the beginning of a step to x*, where its
// forces are evaluated: 1 for the rest of the step, and 2 for the motion to x* of the next step, which may be twice as
// long. If images of the box slide, they have moved by then, and the motion to the next x* gets lists of its own.
constexpr double waysAhead = 3;

std::vector<NodeConditions> conditionsOf(const Cells& cells, const sph::FluidModel& model,
                                         const ParticleSystem& system) {
    std::map<double, NodeConditions> known;  // by the viscosity ratio
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

// `some` with the others that forEach visits, each once.
template <class ForEach>
std::vector<int> withOthers(const std::vector<int>& some, ForEach&& forEach) {
    std::vector<int> all = some;
    forEach([&](int particle) { all.push_back(particle); });
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

}  // namespace

Immersed::Immersed(Cells& cells, const sph::FluidModel& model, const ParticleSystem& system, CellContacts* contacts)
    : cells_(cells),
      system_(system),
      contacts_(contacts),
      map_(system.spacing(), system.support(), conditionsOf(cells, model, system)),
      layout_(cells),
      holes_(system.spacing()) {}

void Immersed::move(double seconds) {
    for (Cell& cell : cells_)
        for (std::size_t n = 0; n < cell.membrane.position.size(); ++n)
            cell.membrane.position[n] += seconds * cell.membrane.velocity[n];
}

void Immersed::depart(double seconds, bool onArc) {
    if (contacts_) departure_ = positionsOf(cells_), departed_ = seconds, outlook_ = waysAhead * seconds;
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

double Immersed::freeDeparture() const {
    if (!contacts_) return 1;
    Vectors way = positionsOf(cells_);
    for (std::size_t m = 0; m < way.size(); ++m) way[m] -= departure_[m];
    return contacts_->freeTravel(cells_, NodeLayout(cells_), system_, departure_,
                                 {std::move(way), departed_, departed_});
}

double Immersed::freeArrival(double seconds, double dt, const Vectors& velocities, double more) const {
    if (!contacts_) return 1;
    const Vectors from = positionsOf(cells_);
    Vectors way(from.size());
    for (std::size_t c = 0; c < layout_.cells(); ++c) {
        const Cell& cell = cells_[c];
        for (std::size_t n = 0, m = layout_.first(c); m < layout_.last(c); ++n, ++m)
            way[m] =
                cell.arc.toChord(from[m]) - seconds * cell.membrane.velocity[n] + (dt + more) * velocities[m] - from[m];
    }
    return contacts_->freeTravel(cells_, layout_, system_, from, {std::move(way), dt + more - seconds});
}

void Immersed::wrapCells() {
    const Periodicity& period = system_.periodicity();
    for (Cell& cell : cells_) {
        membrane::Membrane& m = cell.membrane;
        Vec3 mean = Vec3::Zero();
        for (const Vec3& x : m.position) mean += x / static_cast<double>(m.position.size());
        const int k = period.slidingAxis();
        const double periods = -std::floor((mean[k] - system_.box().low[k]) / period.lengths()[k]);
        if (periods == 0) continue;
        Index3 across{};
        across[static_cast<std::size_t>(k)] = static_cast<int>(periods);
        const Periodicity::Image image = period.image(across);
        for (Vec3& x : m.position) x += image.shift;
        for (Vec3& v : m.velocity) v += image.slide;
    }
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
    holes_.place(cells_, volume_.torn(), system, volume);
    if (holes_.exist()) touched_ = withOthers(map_.touched(), [&](auto&& add) { holes_.forTouched(add); });
    for (Cell& cell : cells_) {
        membrane::Membrane& m = cell.membrane;
        m.force.assign(m.force.size(), Vec3::Zero());
        m.addElasticForces(m.position, m.force);
    }
    if (contacts_) addContact();
}

void Immersed::placeOthers(ParticleSystem& system, const particles::SharedParticles& shared,
                           const std::vector<double>& volume) {
    const GhostRecords ghosts(system, shared, volume);
    map_.placeOthers(cells_, layout_, system, shared, ghosts);
    holes_.placeOthers(system, shared, ghosts);
    if (holes_.exist())
        touchedOthers_ = withOthers(map_.touchedOthers(), [&](auto&& add) { holes_.forTouchedOthers(add); });
}

void Immersed::addContact() {
    Vectors ahead = velocities();
    for (Vec3& one : ahead) one *= outlook_;
    contacts_->place(cells_, layout_, system_, {std::move(ahead), outlook_});
    Vectors f(layout_.nodes(), Vec3::Zero());
    contacts_->addForces(f);
    for (std::size_t c = 0; c < layout_.cells(); ++c)
        for (std::size_t n = 0, m = layout_.first(c); m < layout_.last(c); ++n, ++m)
            cells_[c].membrane.force[n] += f[m];
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
    if (holes_.exist())
        holes_.spread(volume_.applyToForces(f), force);
    else
        volume_.apply(f);
    map_.spread(f, force);
}

void Immersed::spreadToOthers(Vectors f, particles::RealArray& force) const {
    if (holes_.exist())
        holes_.spreadToOthers(volume_.applyToForces(f), force);
    else
        volume_.apply(f);
    map_.spreadToOthers(f, force);
}

}  // namespace corpuscle::coupling
