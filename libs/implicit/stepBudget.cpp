#include "implicit/stepBudget.hpp"

#include <cmath>

namespace corpuscle::implicit {

using particles::setVector;
using particles::vectorAt;
using sph::Budget;

template <class Real>
void StepBudget<Real>::addLeft(const Field& residual, bool first) {
    left_.resize(residual.size());
    for (std::size_t k = 0; k < left_.size(); ++k) left_[k] = residual[k] + (first ? Real(0) : left_[k]);
}

template <class Real>
void StepBudget<Real>::keep(const Field& velocity, const Field& residual, const std::vector<double>& divergence) {
    coupling::Scene& scene = system_.scene();
    const TimeDifference& time = system_.time();
    const RigidUnknowns<Real>* const rigid = system_.rigid();
    const particles::ParticleStore& s = scene.store();
    const Vec3 &g = scene.model().bodyForce, middle = scene.system->box().middle();
    Budget::Values rates = Budget::zero(scene.model().walls.count());
    const bool slides = scene.system->periodicity().slides();
    if (slides) findStep();
    double power = 0, inStep = 0;  // of the terms' forces on all that moves, walls included; of the same in w
    for (std::size_t i = 0; i < s.size(); ++i) {
        rates[Budget::compression] -=
            system_.operators().volume(i) * system_.fluid().pressure(i, divergence[i]) * divergence[i];
        const Vec3 x = s.position(i);
        if (system_.isPrescribed(i)) {
            const Vec3 u = s.velocity(i), f = vectorAt(residual, i);
            power += u.dot(f);
            Budget::addWall(rates, scene.model().walls.nearest(x).number, u, x - middle, -f);
            continue;
        }
        const Vec3 v = vectorAt(velocity, i), a(s.fx[i], s.fy[i], s.fz[i]);
        if (rigid) power += v.dot(system_.force(i));
        if (rigid && slides) inStep += vectorAt(step_, i).dot(system_.force(i));
        if (rigid && rigid->isMember(i)) continue;
        const double mass = system_.mass(i);
        const Vec3 inertia = mass * (time.c1 * (v - s.velocity(i)) - time.c2 * a), byBodyForce = mass * g;
        const Vec3 left = rigid ? Vec3(system_.force(i) + byBodyForce - inertia) : vectorAt(left_, i);
        if (!rigid) power += v.dot(left + inertia - byBodyForce);
        if (slides && !rigid) inStep += vectorAt(step_, i).dot(left + inertia - byBodyForce);
        Budget::addBodyForce(rates, v, x - middle, byBodyForce);
        rates[Budget::kinetic] += v.dot(inertia);
        rates[Budget::ofSolver] += v.dot(left);
    }
    if (rigid) power += rigid->addRates(time.c1, time.c2, velocity, rates);
    if (system_.membranes()) {
        system_.membranes()->addRates(rates);
        // Contact forces are along the normal; walls move at right angles to it.
        for (const auto& on : system_.membranes()->forcesOnWalls()) {
            const boundary::Wall& wall = scene.model().walls[static_cast<std::size_t>(on.wall)];
            Budget::addWall(rates, on.wall, wall.velocityAt(on.place), on.place - middle, -on.force);
        }
    }
    double ofImages = 0;
    if (slides) {
        if (rigid) inStep += rigid->reactionPower(step_);
        ofImages = inStep - system_.slidingPower(velocity, divergence, step_);
        rates[Budget::ofImages] = ofImages - (rigid ? rigid->powerOfSlides(system_.forces()) : 0);
    }
    rates[Budget::viscous] =
        ofImages - power - rates[Budget::compression] - rates[Budget::elastic] - rates[Budget::inMembranes];
    scene.budget.add(time.dt, rates);
}

template <class Real>
void StepBudget<Real>::findStep() {
    const particles::ParticleSystem& system = *system_.scene().system;
    const Periodicity& period = system.periodicity();
    const particles::ParticleStore& s = system.store();
    const int axis = period.slidingAxis();
    const double middle = system.box().middle()[axis], length = period.lengths()[axis];
    const auto at = [&](const Vec3& x) { return (std::floor((x[axis] - middle) / length) + 1) * period.slide(); };
    step_.assign(system_.length(), Real(0));
    for (std::size_t i = 0; i < s.size(); ++i) setVector(step_, i, at(s.position(i)));
    system_.shared().distribute(step_.data(), static_cast<int>(particles::fieldWidth));
    if (system_.rigid()) system_.rigid()->setMotions(at, step_);
}

template class StepBudget<double>;
template class StepBudget<float>;

}  // namespace corpuscle::implicit
