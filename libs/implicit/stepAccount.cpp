#include "implicit/stepAccount.hpp"

namespace corpuscle::implicit {

using particles::vectorAt;
using sph::Account;

template <class Real>
void StepAccount<Real>::addLeft(const Field& residual, bool first) {
    left_.resize(residual.size());
    for (std::size_t k = 0; k < left_.size(); ++k) left_[k] = residual[k] + (first ? Real(0) : left_[k]);
}

template <class Real>
void StepAccount<Real>::keep(const Field& velocity, const Field& residual, const std::vector<double>& divergence) {
    coupling::Scene& scene = system_.scene();
    const TimeDifference& time = system_.time();
    const RigidUnknowns<Real>* const rigid = system_.rigid();
    const particles::ParticleStore& s = scene.store();
    const Vec3 &g = scene.model().bodyForce, middle = scene.system->box().middle();
    Account::Values rates{};
    double power = 0;  // of the terms on everything that moves, walls included
    for (std::size_t i = 0; i < s.size(); ++i) {
        rates[Account::compression] -=
            system_.operators().volume(i) * system_.fluid().pressure(i, divergence[i]) * divergence[i];
        const Vec3 x = s.position(i);
        if (system_.isPrescribed(i)) {
            const Vec3 u = s.velocity(i), f = vectorAt(residual, i);
            power += u.dot(f);
            Account::addWall(rates, scene.model().walls.isUpper(x), u, x - middle, -f);
            continue;
        }
        const Vec3 v = vectorAt(velocity, i), a(s.fx[i], s.fy[i], s.fz[i]);
        if (rigid) power += v.dot(system_.force(i));
        if (rigid && rigid->isMember(i)) continue;
        const double mass = system_.mass(i);
        const Vec3 inertia = mass * (time.c1 * (v - s.velocity(i)) - time.c2 * a), byBodyForce = mass * g;
        const Vec3 left = rigid ? Vec3(system_.force(i) + byBodyForce - inertia) : vectorAt(left_, i);
        if (!rigid) power += v.dot(left + inertia - byBodyForce);
        Account::addBodyForce(rates, v, x - middle, byBodyForce);
        rates[Account::kinetic] += v.dot(inertia);
        rates[Account::ofSolver] += v.dot(left);
    }
    if (rigid) power += rigid->addRates(time.c1, time.c2, velocity, rates);
    if (system_.membranes() && scene.system->decomposition().rank() == 0) system_.membranes()->addRates(rates);
    rates[Account::viscous] =
        -power - rates[Account::compression] - rates[Account::elastic] - rates[Account::inMembranes];
    scene.account.add(time.dt, rates);
}

template class StepAccount<double>;
template class StepAccount<float>;

}  // namespace corpuscle::implicit
