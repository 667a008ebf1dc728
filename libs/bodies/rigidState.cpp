#include "bodies/rigidState.hpp"

namespace corpuscle::bodies {

Vec3 RigidState::angularMomentum(const Solid& solid) const {
    const Mat3 R = rotation();
    return R * solid.inertia.cwiseProduct(R.transpose() * motion.angular);
}

void RigidState::setAngularMomentum(const Solid& solid, const Vec3& L) {
    const Mat3 R = rotation();
    motion.angular = R * (R.transpose() * L).cwiseQuotient(solid.inertia);
}

void kick(RigidState& state, const Solid& solid, const Wrench& wrench, double dt) {
    state.motion.linear += dt / solid.mass * wrench.force;
    state.setAngularMomentum(solid, state.angularMomentum(solid) + dt * wrench.torque);
}

void drift(RigidState& state, const Solid& solid, double dt) {
    state.centre += dt * state.motion.linear;
    const Vec3 L = state.angularMomentum(solid);
    Vec3 inBody = state.orientation.conjugate() * L;
    const auto turn = [&](int k, double time) {
        const Eigen::Quaterniond by(Eigen::AngleAxisd(time * inBody[k] / solid.inertia[k], Vec3::Unit(k)));
        state.orientation = state.orientation * by;
        inBody = by.conjugate() * inBody;
    };
    turn(0, 0.5 * dt), turn(1, 0.5 * dt), turn(2, dt), turn(1, 0.5 * dt), turn(0, 0.5 * dt);
    state.orientation.normalize();
    state.setAngularMomentum(solid, L);
}

void drive(RigidState& state, double dt) {
    state.centre += dt * state.motion.linear;
    const double rate = state.motion.angular.norm();
    if (rate == 0) return;
    const Eigen::Quaterniond by(Eigen::AngleAxisd(rate * dt, state.motion.angular / rate));
    state.orientation = (by * state.orientation).normalized();
}

}  // namespace corpuscle::bodies
