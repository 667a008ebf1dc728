#include "implicit/membraneTerm.hpp"

#include <fmt/core.h>

#include "core/communicator.hpp"
#include "implicit/stepControl.hpp"

namespace corpuscle::implicit {

template <class Real>
void MembraneTerm<Real>::prepare(const Reach& reach) {
    reach_ = reach;
    immersed_.build(system_, volumes_);
    load_ = immersed_.force();
    immersed_.addStiffness(reach_.middle, immersed_.velocities(), load_);
}

template <class Real>
void MembraneTerm<Real>::addFirstForces(const Field& v0, Forces& forces) {
    nodes_ = extrapolated_ = immersed_.interpolateVelocities(v0.data());
    immersed_.addStiffness(reach_.lead, extrapolated_, load_);
    give(nodes_, forces);
}

template <class Real>
void MembraneTerm<Real>::addForces(const Field& v, Forces& forces) {
    nodes_ = immersed_.interpolateVelocities(v.data());
    give(nodes_, forces);
}

template <class Real>
void MembraneTerm<Real>::give(const Vectors& nodes, Forces& forces) const {
    Vectors f = load_;
    immersed_.addResistance(reach_.total(), nodes, f);
    immersed_.spread(std::move(f), forces);
}

template <class Real>
void MembraneTerm<Real>::addProduct(const Field& v, Forces& forces) {
    Vectors f(load_.size(), Vec3::Zero());
    immersed_.addResistance(reach_.total(), immersed_.interpolate(v.data()), f);
    immersed_.spread(std::move(f), forces);
}

template <class Real>
std::string MembraneTerm<Real>::whyNot(const Field& v, double dt) {
    nodes_ = immersed_.interpolateVelocities(v.data());
    const double change = Communicator(system_.comm()).max(largestBondRate(immersed_, nodes_)) * dt;
    if (change <= settings_.bondStrain) {
        if (immersed_.freeArrival(reach_.middle, dt, nodes_, 0) == 1) return {};
        return "membranes would meet";
    }
    return fmt::format("a bond would change its length by {:.3g}, more than 'implicit.bondStrain'", change);
}

template <class Real>
auto MembraneTerm<Real>::displacement() const -> Vectors {
    Vectors displacement = nodes_;
    const Vectors before = immersed_.velocities();
    for (std::size_t m = 0; m < nodes_.size(); ++m)
        displacement[m] = reach_.middle * (nodes_[m] - before[m]) + reach_.lead * (nodes_[m] - extrapolated_[m]);
    return displacement;
}

template <class Real>
std::vector<coupling::CellContacts::OnWall> MembraneTerm<Real>::forcesOnWalls() const {
    if (!immersed_.contacts()) return {};
    return immersed_.contacts()->forcesOnWalls(immersed_.cells(), Communicator(system_.comm()).rank(), displacement());
}

template <class Real>
void MembraneTerm<Real>::addDefect(Forces& forces) {
    defect_ = immersed_.forceAt(displacement());
    Vectors linear = load_;
    immersed_.addStiffness(-reach_.total(), nodes_, linear);
    for (std::size_t m = 0; m < defect_.size(); ++m) defect_[m] -= linear[m];
    immersed_.spread(defect_, forces);
}

template <class Real>
void MembraneTerm<Real>::takeDefect() {
    for (std::size_t m = 0; m < defect_.size(); ++m) load_[m] += defect_[m];
}

template <class Real>
double MembraneTerm<Real>::power(const Field& v, const Field& w) {
    const Vectors disturbance = immersed_.interpolate(w.data());
    Vectors f = load_;
    immersed_.addResistance(reach_.total(), immersed_.interpolateVelocities(v.data()), f);
    return immersed_.ownDot(disturbance, f);
}

template <class Real>
double MembraneTerm<Real>::slidingPower(const Field& /*v*/, const std::vector<double>& /*divergence*/, const Field& w) {
    Vectors f = load_;
    immersed_.addResistance(reach_.total(), nodes_, f);
    return immersed_.ownDot(immersed_.interpolateVelocities(w.data()), f) + contactAcrossImages();
}

template <class Real>
double MembraneTerm<Real>::contactAcrossImages() const {
    return immersed_.contacts() ? immersed_.contacts()->powerOfImages(system_.periodicity(), displacement()) : 0;
}

template <class Real>
void MembraneTerm<Real>::addRates(sph::Budget::Values& rates) const {
    Vectors elastic = load_, viscous(nodes_.size(), Vec3::Zero());
    immersed_.addStiffness(-reach_.total(), nodes_, elastic);
    immersed_.addDamping(nodes_, viscous);
    rates[sph::Budget::elastic] -= immersed_.ownDot(nodes_, elastic) + contactAcrossImages();
    rates[sph::Budget::inMembranes] -= immersed_.ownDot(nodes_, viscous);
}

template class MembraneTerm<double>;
template class MembraneTerm<float>;

}  // namespace corpuscle::implicit
