// Family of the motions of a rigid body: what it does under force and torque.
#pragma once
#include <optional>

#include "bodies/rigidState.hpp"
#include "core/registry.hpp"

namespace corpuscle::bodies {

class BodyMotion {
  public:
    static constexpr const char* familyName = "body motion";
    virtual ~BodyMotion() = default;
    // At t = 0; `flow`: that of the undisturbed flow at its centre.
    virtual RigidMotion start(const RigidMotion& flow) const = 0;
    // The largest speed that the motion prescribes to a body of this radius [m/s].
    virtual double speed(double /*radius*/) const { return 0; }
    // Whether it yields to forces at all.
    virtual bool yields() const { return false; }
    // Acceleration by a force and a torque: the inverse of mass and inertia, 0 for what does not yield.
    virtual RigidMotion response(const RigidState&, const Solid&, const Wrench&) const { return {}; }
    // Velocity Verlet: half a kick and the drift; the second half.
    virtual void advance(RigidState& state, const Solid& solid, const Wrench& wrench, double dt) const = 0;
    virtual void finish(RigidState&, const Solid&, const Wrench&, double /*dt*/) const {}
};

}  // namespace corpuscle::bodies
