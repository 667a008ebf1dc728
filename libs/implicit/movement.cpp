#include "implicit/movement.hpp"

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
void Movement<Real>::moveFluid(double seconds) {
    ParticleStore& s = system_.scene().store();
    for (std::size_t i = 0; i < s.size(); ++i) s.setPosition(i, s.position(i) + seconds * s.velocity(i));
}

template <class Real>
void Movement<Real>::depart(const TimeDifference& time) {
    moveFluid(time.begin());
    if (system_.immersed()) system_.immersed()->depart(time.begin(), !time.isAtEnd());
    if (system_.rigid()) system_.rigid()->depart(time.begin());
    system_.scene().system->moveImages(time.begin());
    system_.scene().system->rebuild();
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
    if (system_.rigid()) system_.rigid()->arrive(dt, time.h, velocity);
    particles::ParticleSystem& system = *system_.scene().system;
    system.moveImages(dt - time.begin());
    if (noFlux_) noFlux_->keepSides(system);
    if (!system.periodicity().slides()) return;
    system.wrapAll();  // what looks at velocities until the next step need not ask of which image they are
    if (system_.immersed()) system_.immersed()->wrapCells();
}

template class Movement<double>;
template class Movement<float>;

}  // namespace corpuscle::implicit
