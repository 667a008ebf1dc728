#include "implicit/movement.hpp"

#include <algorithm>

namespace corpuscle::implicit {

using particles::ParticleStore;
using particles::vectorAt;

template <class Real>
void Movement<Real>::moveVelocities(double seconds) {
    ParticleStore& s = system_.scene().store();
    for (std::size_t i = 0; i < s.size(); ++i)
        s.setVelocity(i, s.velocity(i) + seconds * Vec3(s.fx[i], s.fy[i], s.fz[i]));
    if (system_.rigid()) system_.rigid()->moveVelocities(seconds);
}

template <class Real>
void Movement<Real>::stopAccelerating() {
    ParticleStore& s = system_.scene().store();
    for (auto* a : {&s.fx, &s.fy, &s.fz}) std::fill(a->begin(), a->end(), 0.0);
    if (system_.rigid()) system_.rigid()->stopAccelerating();
}

template <class Real>
void Movement<Real>::moveFluid(double seconds) {
    ParticleStore& s = system_.scene().store();
    for (std::size_t i = 0; i < s.size(); ++i) s.setPosition(i, s.position(i) + seconds * s.velocity(i));
}

// Books the momentum and energy that particles gain where `wrap` moves them across the faces between sliding images.
template <class Real>
template <class Wrap>
void Movement<Real>::countCrossings(Wrap&& wrap) {
    coupling::Scene& scene = system_.scene();
    if (!scene.budget.kept || !scene.system->periodicity().slides()) return wrap();
    const ParticleStore& s = scene.store();
    const auto add = [&](double sign) {
        double energy = 0;
        Vec3 momentum = Vec3::Zero();
        for (std::size_t i = 0; i < s.size(); ++i) {
            if (particles::isBoundary(s.kindOf(i))) continue;
            const Vec3 u = s.velocity(i);
            energy += 0.5 * system_.mass(i) * u.squaredNorm(), momentum += system_.mass(i) * u;
        }
        scene.budget.total[sph::Budget::ofImages] += sign * energy;
        sph::Budget::add(scene.budget.total, sph::Budget::images, sign * momentum);
    };
    add(-1);
    wrap();
    add(1);
}

template <class Real>
void Movement<Real>::depart(const TimeDifference& time) {
    moveFluid(time.begin());
    if (system_.immersed()) system_.immersed()->depart(time.begin(), !time.isAtEnd());
    system_.scene().system->moveImages(time.begin());
    if (system_.rigid()) system_.rigid()->depart(time.begin());
    countCrossings([&] { system_.scene().system->rebuild(); });
}

template <class Real>
void Movement<Real>::takeBack(const TimeDifference& time) {
    moveFluid(-time.begin());
    system_.scene().system->moveImages(-time.begin());
    if (system_.immersed()) system_.immersed()->takeBack(time.begin());
    if (system_.rigid()) system_.rigid()->takeBack();
}

template <class Real>
void Movement<Real>::arrive(const Field& velocity) {
    const TimeDifference& time = system_.time();
    const double dt = time.dt;
    ParticleStore& s = system_.scene().store();
    transport_.shift(system_.operators(), dt);
    if (coupling::Immersed* const immersed = system_.immersed()) {
        immersed->takeBack(time.begin());
        immersed->setVelocities(system_.membranes()->velocities());
        transport_.holdAtMembranes(*noFlux_, dt, [&](std::size_t i) { return vectorAt(velocity, i); });
        immersed->move(dt);
        immersed->restoreVolume();
    }
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec3 v = system_.isPrescribed(i) ? s.velocity(i) : vectorAt(velocity, i), u = s.velocity(i);
        s.setPosition(i, s.position(i) + dt * v - time.begin() * u + transport_[i]);
        const Vec3 a = (v - u) / time.h;
        s.fx[i] = a[0], s.fy[i] = a[1], s.fz[i] = a[2];
        s.setVelocity(i, v);
    }
    particles::ParticleSystem& system = *system_.scene().system;
    system.moveImages(dt - time.begin());
    if (system_.rigid()) system_.rigid()->arrive(dt, time.h, velocity);
    if (noFlux_) noFlux_->keepSides(system);
    coupling::keepWithinWalls(system_.scene(), [&](std::size_t i) { return system_.operators().wallGap(i); });
    if (!system.periodicity().slides()) return;
    // So that code that reads velocities before the next step need not ask to which image they belong.
    countCrossings([&] { system.wrapAll(); });
    if (system_.immersed()) system_.immersed()->wrapCells();
}

template class Movement<double>;
template class Movement<float>;

}  // namespace corpuscle::implicit
