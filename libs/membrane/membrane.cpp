#include "membrane/membrane.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "core/error.hpp"
#include "membrane/diagnostics.hpp"
#include "membrane/surface.hpp"

namespace corpuscle::membrane {

MembraneType::MembraneType(std::vector<Vec3> stressFree, std::vector<Index3> triangles,
                           const MembraneSettings& settings, double radius)
    : network_(std::move(stressFree), std::move(triangles)),
      laws_(settings),
      scale_{laws_.moduli(network_.meanBondLength()).shear, radius} {
    if (laws_.bonds) {
        terms_.push_back(laws_.bonds->makeTerm(network_));
    }
    if (laws_.triangles) {
        terms_.push_back(laws_.triangles->makeTerm(network_));
    }
    if (laws_.angles) {
        terms_.push_back(laws_.angles->makeTerm(network_));
    }
    if (laws_.bending) {
        terms_.push_back(laws_.bending->makeTerm(network_, scale_));
    }
    const AreaConstraint area = laws_.area.value_or(AreaConstraint{});
    for (auto& term : area.makeTerms(network_)) {
        terms_.push_back(std::move(term));
    }
    if (laws_.volume) {
        terms_.push_back(laws_.volume->makeTerm(network_, area.restArea(network_)));
    }
    if (laws_.rim) {
        terms_.push_back(laws_.rim->makeTerm(network_));
    }
}

Membrane::Membrane(std::string nameOfCell, int cellNumber, std::vector<Vec3> nodes, std::shared_ptr<MembraneType> type)
    : name(std::move(nameOfCell)),
      cell(cellNumber),
      position(nodes),
      velocity(nodes.size(), Vec3::Zero()),
      force(nodes.size(), Vec3::Zero()),
      initialPosition_(std::move(nodes)),
      type_(std::move(type)) {
    if (laws().pores) pores_.assign(network().nodeCount(), 0.0);
    if (!canRupture()) return;
    damage_.assign(laws().rupture->damageSize(network()), 0.0);
    if (laws().rupture->weakens()) whole_ = type_;
}

Membrane::Membrane(std::string nameOfCell, int cellNumber, const std::vector<Vec3>& nodes,
                   std::vector<Index3> triangles, const MembraneSettings& settings, double radius,
                   std::vector<Vec3> stressFree)
    : Membrane(std::move(nameOfCell), cellNumber, nodes,
               std::make_shared<MembraneType>(stressFree.empty() ? std::vector<Vec3>(nodes) : std::move(stressFree),
                                              std::move(triangles), settings, radius)) {}

// The new type is built from the data that rupture leaves unchanged, since some terms read rest values off the living
// elements.
Network& Membrane::ownNetwork() {
    if (type_.use_count() > 1) {
        const std::vector<char> alive = network().aliveBonds();
        std::vector<double> shares = network().shares();
        type_ = std::make_shared<MembraneType>(network().stressFree(), network().triangles(), laws(), scale().radius);
        type_->network_.restore(alive);
        type_->network_.weaken(std::move(shares));
    }
    return type_->network_;
}

RuptureStep Membrane::ruptureStep(std::span<const Vec3> x, double dt) const {
    return {network(), laws(),  x,
            dt,        damage_, whole_ ? std::span(whole_->terms()) : std::span<const std::unique_ptr<Term>>{}};
}

void Membrane::weaken() {
    std::vector<double> shares = laws().rupture->shares(network(), damage_);
    if (!shares.empty() || network().isWeakened()) ownNetwork().weaken(std::move(shares));
}

void Membrane::computeForces() {
    std::fill(force.begin(), force.end(), Vec3::Zero());
    addElasticForces(position, force);
    if (isViscous()) {
        addViscousForces(velocity, force);
    }
}

void Membrane::addElasticForces(std::span<const Vec3> x, std::span<Vec3> f) const {
    for (const auto& term : type_->terms()) {
        term->addForces(x, f);
    }
}

void Membrane::addViscousForces(std::span<const Vec3> v, std::span<Vec3> f) const {
    laws().viscosity->addForces(network(), {position, velocity}, v, f);
}

double Membrane::energy() const {
    double sum = 0;
    for (const auto& term : type_->terms()) {
        sum += term->energy(position);
    }
    return sum;
}

void Membrane::addStiffness(Definiteness definiteness, Stiffness& stiffness) const {
    for (const auto& term : type_->terms()) {
        term->addStiffness(position, definiteness, stiffness);
    }
}

void Membrane::addDamping(Stiffness& damping) const {
    if (isViscous()) {
        laws().viscosity->addDamping(network(), {position, velocity}, damping);
    }
}

double Membrane::maxStiffness() const {
    double sum = 0;
    for (const auto& term : type_->terms()) {
        sum += term->maxStiffness(position);
    }
    return sum;
}

std::vector<BrokenBond> Membrane::findBroken(double dt) {
    if (!canRupture()) return {};
    laws().rupture->gather(ruptureStep(position, dt), damage_);
    if (canWeaken()) {
        weaken();
        if (const std::vector<int> resealed = laws().rupture->resealed(ruptureStep(position, dt)); !resealed.empty())
            ownNetwork().resealBonds(resealed);
    }
    return laws().rupture->select(ruptureStep(position, dt));
}

std::vector<BrokenBond> Membrane::breakBonds(std::vector<BrokenBond> broken) {
    std::vector<BrokenBond> all;
    while (!broken.empty()) {
        std::vector<int> numbers;
        numbers.reserve(broken.size());
        for (const BrokenBond& bond : broken) numbers.push_back(bond.bond);
        ownNetwork().breakBonds(numbers);
        all.insert(all.end(), broken.begin(), broken.end());
        broken = findBroken(0);
    }
    return all;
}

double Membrane::ruptureExcess(std::span<const Vec3> x, double dt, std::size_t rank) const {
    if (!canRupture()) return -1;
    std::vector<double> all = laws().rupture->excesses(ruptureStep(x, dt));
    if (rank >= all.size()) return -1;
    const auto at = all.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(all.begin(), at, all.end(), std::greater<>());
    return *at;
}

double Membrane::maxDamage() const {
    if (damage_.empty()) return 0;
    double most = 0;
    for (const int t : network().wholeTriangles()) {
        if (laws().rupture->damageOf() == RuptureLaw::DamageOf::triangles)
            most = std::max(most, damage_[t]);
        else
            for (const int n : network().triangles()[t]) most = std::max(most, damage_[n]);
    }
    return most;
}

double Membrane::tearLength() const { return canRupture() ? laws().rupture->tearLength(network(), damage_) : 0; }

void Membrane::openPores(double dt) {
    if (!laws().pores) return;
    if (network().wasOpen()) return std::fill(pores_.begin(), pores_.end(), 0.0);
    const std::vector<double> atRest = laws().pores->atRest(network(), laws(), position);
    for (std::size_t n = 0; n < pores_.size(); ++n) pores_[n] = laws().pores->after(pores_[n], atRest[n], dt);
}

double Membrane::poreArea() const {
    if (pores_.empty()) return 0;
    const std::vector<double> areas = vertexAreas();
    return std::inner_product(areas.begin(), areas.end(), pores_.begin(), 0.0);
}

void Membrane::restore(std::vector<char> aliveBonds, std::vector<double> damage, std::vector<double> pores) {
    if (!damage.empty() && !damage_.empty() && damage.size() != damage_.size()) {
        throw Failure(ExitCode::io, "checkpoint holds the damage of " + std::to_string(damage.size()) +
                                        " triangles or nodes of membrane " + name + ", which has " +
                                        std::to_string(damage_.size()) + "; start from firstTime");
    }
    if (aliveBonds != network().aliveBonds()) {
        ownNetwork().restore(std::move(aliveBonds));
    }
    // Where only one of the checkpoint and the present law has damage, the membrane continues undamaged.
    if (damage.empty() || damage_.empty()) {
        std::fill(damage_.begin(), damage_.end(), 0.0);
    } else {
        damage_ = std::move(damage);
    }
    if (canWeaken()) weaken();
    if (pores.size() == pores_.size())
        pores_ = std::move(pores);
    else
        std::fill(pores_.begin(), pores_.end(), 0.0);
}

double Membrane::area() const {
    double sum = 0;
    for (const int t : network().wholeTriangles()) {
        sum += areaVector(position, network().triangles()[t]).norm();
    }
    return sum;
}

double Membrane::volume() const {
    const Vec3 origin = position.front();
    double sum = 0;
    for (const int t : network().wholeTriangles()) {
        const Index3& corner = network().triangles()[t];
        sum += tetrahedron(position[corner[0]], position[corner[1]], position[corner[2]], origin);
    }
    if (network().brokenTriangles() > 0) {
        for (const auto& rim : network().rims()) {
            sum += fanVolume(position, rim, origin);
        }
    }
    return sum;
}

std::vector<double> Membrane::vertexAreas() const { return membrane::vertexAreas(network(), position); }

}  // namespace corpuscle::membrane
