#include "membrane/membrane.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "membrane/diagnostics.hpp"
#include "membrane/surface.hpp"

namespace corpuscle::membrane {

Membrane::Membrane(std::string nameOfCell, int cellNumber, std::vector<Vec3> nodes, std::vector<Index3> triangles,
                   const MembraneSettings& settings, double radius, std::vector<Vec3> stressFree)
    : name(std::move(nameOfCell)),
      cell(cellNumber),
      position(nodes),
      velocity(nodes.size(), Vec3::Zero()),
      force(nodes.size(), Vec3::Zero()),
      initialPosition_(std::move(nodes)),
      network_(std::make_unique<Network>(stressFree.empty() ? initialPosition_ : std::move(stressFree),
                                         std::move(triangles))),
      laws_(settings),
      scale_{laws_.moduli(network_->meanBondLength()).shear, radius} {
    if (settings.bonds) {
        terms_.push_back(settings.bonds->makeTerm(*network_));
    }
    if (settings.triangles) {
        terms_.push_back(settings.triangles->makeTerm(*network_));
    }
    if (settings.angles) {
        terms_.push_back(settings.angles->makeTerm(*network_));
    }
    if (settings.bending) {
        terms_.push_back(settings.bending->makeTerm(*network_, scale_));
    }
    const AreaConstraint area = settings.area.value_or(AreaConstraint{});
    for (auto& term : area.makeTerms(*network_)) {
        terms_.push_back(std::move(term));
    }
    if (settings.volume) {
        terms_.push_back(settings.volume->makeTerm(*network_, area.restArea(*network_)));
    }
    if (canRupture() && laws_.rupture->keepsDamage()) {
        damage_.assign(network_->triangles().size(), 0.0);
    }
}

void Membrane::computeForces() {
    std::fill(force.begin(), force.end(), Vec3::Zero());
    addElasticForces(position, force);
    if (isViscous()) {
        addViscousForces(velocity, force);
    }
}

void Membrane::addElasticForces(std::span<const Vec3> x, std::span<Vec3> f) const {
    for (const auto& term : terms_) {
        term->addForces(x, f);
    }
}

void Membrane::addViscousForces(std::span<const Vec3> v, std::span<Vec3> f) const {
    laws_.viscosity->addForces(*network_, {position, velocity}, v, f);
}

double Membrane::energy() const {
    double sum = 0;
    for (const auto& term : terms_) {
        sum += term->energy(position);
    }
    return sum;
}

void Membrane::addStiffness(Definiteness definiteness, Stiffness& stiffness) const {
    for (const auto& term : terms_) {
        term->addStiffness(position, definiteness, stiffness);
    }
}

void Membrane::addDamping(Stiffness& damping) const {
    if (isViscous()) {
        laws_.viscosity->addDamping(*network_, {position, velocity}, damping);
    }
}

double Membrane::maxStiffness() const {
    double sum = 0;
    for (const auto& term : terms_) {
        sum += term->maxStiffness(position);
    }
    return sum;
}

std::vector<BrokenBond> Membrane::findBroken(double dt) {
    return canRupture() ? laws_.rupture->select({*network_, laws_, position, dt, damage_}) : std::vector<BrokenBond>{};
}

void Membrane::breakBonds(const std::vector<BrokenBond>& broken) {
    if (broken.empty()) return;
    std::vector<int> numbers;
    numbers.reserve(broken.size());
    for (const BrokenBond& bond : broken) numbers.push_back(bond.bond);
    network_->breakBonds(numbers);
}

void Membrane::restore(std::vector<char> aliveBonds, std::vector<double> damage) {
    if (!damage.empty() && !damage_.empty() && damage.size() != damage_.size()) {
        throw Failure(ExitCode::io, "checkpoint holds the damage of " + std::to_string(damage.size()) +
                                        " triangles of membrane " + name + ", which has " +
                                        std::to_string(damage_.size()) + "; start from firstTime");
    }
    network_->restore(std::move(aliveBonds));
    // Between a law that keeps damage and one that does not, the membrane goes on undamaged.
    if (damage.empty() || damage_.empty()) {
        std::fill(damage_.begin(), damage_.end(), 0.0);
        return;
    }
    damage_ = std::move(damage);
}

double Membrane::area() const {
    double sum = 0;
    for (const int t : network_->wholeTriangles()) {
        sum += areaVector(position, network_->triangles()[t]).norm();
    }
    return sum;
}

double Membrane::volume() const {
    const Vec3 origin = position.front();
    double sum = 0;
    for (const int t : network_->wholeTriangles()) {
        const Index3& corner = network_->triangles()[t];
        sum += tetrahedron(position[corner[0]], position[corner[1]], position[corner[2]], origin);
    }
    if (network_->brokenTriangles() > 0) {
        for (const auto& rim : network_->rims()) {
            sum += fanVolume(position, rim, origin);
        }
    }
    return sum;
}

std::vector<double> Membrane::vertexAreas() const { return membrane::vertexAreas(*network_, position); }

}  // namespace corpuscle::membrane
