// Family of motions of a rigid body: how it moves under force and torque.
#pragma once
#include <optional>

#include "bodies/rigidState.hpp"
#include "core/registry.hpp"

namespace corpuscle::bodies {

class BodyMotion {
  public:
    static constexpr const char* familyName = "body motion";
    virtual ~BodyMotion() = default;
    // Motion at t = 0; flow: motion of the undisturbed flow at the centre of the body.
    virtual RigidMotion start(const RigidMotion& flow) const = 0;
    // The largest speed that the motion prescribes on the surface of a body of this radius [m/s].
    virtual double speed(double /*radius*/) const { return 0; }
    // Whether forces change the motion at all.
    virtual bool yields() const { return false; }
    // Acceleration by a force and a torque, that is, the inverse of mass and inertia; 0 if the body does not yield.
    virtual RigidMotion response(const RigidState&, const Solid&, const Wrench&) const { return {}; }
    // Velocity Verlet. advance: first half of the kick, and the drift; finish: second half of the kick.
    virtual void advance(RigidState& state, const Solid& solid, const Wrench& wrench, double dt) const = 0;
    virtual void finish(RigidState&, const Solid&, const Wrench&, double /*dt*/) const {}
};

}  // namespace corpuscle::bodies
