// Motions of a rigid body.
//
// held   | stays where it is
// driven | U and Omega are prescribed and constant
// free   | moves under the force and torque of the fluid (rigidState.hpp)
#include "bodies/bodyMotion.hpp"

namespace corpuscle::bodies {

namespace {

struct Held : BodyMotion {
    static const Schema<Held>& schema() {
        static const Schema<Held> s("held", "stays where it is");
        return s;
    }
    RigidMotion start(const RigidMotion&) const override { return {}; }
    void advance(RigidState&, const Solid&, const Wrench&, double) const override {}
};

struct Driven : BodyMotion {
    Vec3 velocity = Vec3::Zero(), angularVelocity = Vec3::Zero();
    static const Schema<Driven>& schema() {
        static const Schema<Driven> s =
            Schema<Driven>("driven", "moves and turns at constant rates")
                .vector("velocity", &Driven::velocity, unit::metrePerSecond, "of its centre of mass",
                        {.fallback = "[0 m/s, 0 m/s, 0 m/s]"})
                .vector("angularVelocity", &Driven::angularVelocity, unit::perSecond, "about its centre of mass",
                        {.fallback = "[0 1/s, 0 1/s, 0 1/s]"})
                .check([](const Driven& d, const Node& node, Problems& problems) {
                    if (d.velocity.isZero() && d.angularVelocity.isZero())
                        problems.add(node.place(), node.path,
                                     "is driven, but neither velocity nor angularVelocity is other than 0; give one of "
                                     "them, or write held");
                });
        return s;
    }
    RigidMotion start(const RigidMotion&) const override { return {velocity, angularVelocity}; }
    double speed(double radius) const override { return velocity.norm() + angularVelocity.norm() * radius; }
    void advance(RigidState& state, const Solid&, const Wrench&, double dt) const override { drive(state, dt); }
};

struct Free : BodyMotion {
    std::optional<Vec3> velocity, angularVelocity;
    static const Schema<Free>& schema() {
        static const Schema<Free> s =
            Schema<Free>("free", "moves by what the fluid does to it")
                .vectorOr("flow", "velocity", &Free::velocity, unit::metrePerSecond,
                          "of its centre of mass at t = 0; flow: that of the undisturbed flow there",
                          {.fallback = "flow"})
                .vectorOr("flow", "angularVelocity", &Free::angularVelocity, unit::perSecond,
                          "about its centre of mass at t = 0; flow: half the curl of the undisturbed flow there",
                          {.fallback = "flow"});
        return s;
    }
    RigidMotion start(const RigidMotion& flow) const override {
        return {velocity.value_or(flow.linear), angularVelocity.value_or(flow.angular)};
    }
    bool yields() const override { return true; }
    RigidMotion response(const RigidState& state, const Solid& solid, const Wrench& wrench) const override {
        RigidState from = state;
        from.setAngularMomentum(solid, wrench.torque);
        return {wrench.force / solid.mass, from.motion.angular};
    }
    void advance(RigidState& state, const Solid& solid, const Wrench& wrench, double dt) const override {
        kick(state, solid, wrench, 0.5 * dt);
        drift(state, solid, dt);
    }
    void finish(RigidState& state, const Solid& solid, const Wrench& wrench, double dt) const override {
        kick(state, solid, wrench, 0.5 * dt);
    }
};

CORPUSCLE_REGISTER(BodyMotion, Held, "held", "stays where it is");
CORPUSCLE_REGISTER(BodyMotion, Driven, "driven", "moves and turns at constant rates");
CORPUSCLE_REGISTER(BodyMotion, Free, "free", "moves by what the fluid does to it");

}  // namespace
}  // namespace corpuscle::bodies
