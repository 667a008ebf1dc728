#include "implicit/membraneTerm.hpp"

#include <fmt/core.h>

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
    nodes_ = extrapolated_ = immersed_.interpolate(v0.data());
    immersed_.addStiffness(reach_.lead, extrapolated_, load_);
    give(nodes_, forces);
}

template <class Real>
void MembraneTerm<Real>::addForces(const Field& v, Forces& forces) {
    nodes_ = immersed_.interpolate(v.data());
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
std::string MembraneTerm<Real>::refusal(const Field& v, double dt) {
    nodes_ = immersed_.interpolate(v.data());
    const double change = largestBondRate(immersed_.cells(), nodes_) * dt;
    if (change <= settings_.bondStrain) return {};
    return fmt::format("a bond would change its length by {:.3g}, more than 'implicit.bondStrain'", change);
}

template <class Real>
void MembraneTerm<Real>::addDefect(Forces& forces) {
    Vectors displacement = nodes_;
    const Vectors before = immersed_.velocities();
    for (std::size_t m = 0; m < nodes_.size(); ++m)
        displacement[m] = reach_.middle * (nodes_[m] - before[m]) + reach_.lead * (nodes_[m] - extrapolated_[m]);
    defect_ = immersed_.forceAt(displacement);
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
    immersed_.addResistance(reach_.total(), immersed_.interpolate(v.data()), f);
    double sum = 0;
    for (std::size_t m = 0; m < f.size(); ++m) sum += disturbance[m].dot(f[m]);
    return sum;
}

template <class Real>
void MembraneTerm<Real>::addRates(sph::Budget::Values& rates) const {
    Vectors elastic = load_, viscous(nodes_.size(), Vec3::Zero());
    immersed_.addStiffness(-reach_.total(), nodes_, elastic);
    immersed_.addDamping(nodes_, viscous);
    for (std::size_t m = 0; m < nodes_.size(); ++m) {
        rates[sph::Budget::elastic] -= nodes_[m].dot(elastic[m]);
        rates[sph::Budget::inMembranes] -= nodes_[m].dot(viscous[m]);
    }
}

template class MembraneTerm<double>;
template class MembraneTerm<float>;

}  // namespace corpuscle::implicit
