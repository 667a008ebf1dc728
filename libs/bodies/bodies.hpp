// The rigid bodies of a scene and their particles: a Load of velocity Verlet.
//
// A body's particles are particles of the fluid that move with it: they push back as walls do (density by the
// continuity equation) and stand for the velocity that continues the fluid's beyond the surface (sph/fluidPair.hpp).
// What acts on them is gathered on the body (sph/rigidGroups.hpp), whose motion follows (rigidState.hpp).
//
//     drifted            half a kick and the drift of each body; its particles to their new places
//     moved              after a rebuild, who is here; at each step, arms and distances
//     addAccelerations   force and torque taken up
//     kicked             second half of the kick; velocities of the particles
//
// A uniform body force stands for a pressure gradient: it acts on a body's volume as on the fluid's, with rho0 b V.
#pragma once
#include "bodies/body.hpp"
#include "sph/velocityVerlet.hpp"

namespace corpuscle::bodies {

class Bodies : public sph::Load {
  public:
    struct Medium {
        double density = 0;             // rho0 of the fluid [kg/m^3]
        Vec3 bodyForce = Vec3::Zero();  // [m/s^2]
        double spacing = 0;             // [m]
        // A fluid particle that has come closer to a surface than this counts as so far away [spacings]: what it would
        // feel otherwise bounds an explicit step. What it feels less makes bodies look smaller, by 0.04 dx with 0.25.
        double leastDistance = 0.25;
        static constexpr double unlimited = 0.05;  // where the step has no such bound
    };
    // The bodies are filled.
    Bodies(std::vector<Body> bodies, const Medium& medium);

    const std::vector<Body>& all() const { return bodies_; }
    std::vector<Body>& all() { return bodies_; }
    sph::RigidGroups& groups() { return groups_; }
    // The body of a particle, by its number `member`.
    std::size_t bodyOf(std::int64_t member) const;

    void drifted(particles::ParticleSystem& system, double dt) override;
    void moved(particles::ParticleSystem& system, double extrapolation, bool rebuilt) override;
    void addAccelerations(particles::ParticleSystem& system) override;
    void kicked(particles::ParticleSystem& system, double dt) override;
    void addRates(const particles::ParticleSystem& system, const sph::FluidForces& forces,
                  sph::Budget::Values& rates) const override;
    // The same of one body of this motion, acted on by its wrench; on the root only.
    void addRates(const particles::ParticleSystem& system, const Body& body, const RigidMotion& motion,
                  sph::Budget::Values& rates) const;

    // For whoever steps bodies and particles in another way: who of the bodies' particles is here, after particles have
    // changed their order; and these to their places, the images nearest to where they are.
    void findMembers(const particles::ParticleSystem& system);
    void place(particles::ParticleSystem& system) const;

  private:
    void findCandidates(const particles::ParticleSystem& system);
    void updateNear(const particles::ParticleSystem& system);

    std::vector<Body> bodies_;
    Medium medium_;
    sph::RigidGroups groups_;
    std::vector<const BodyParticle*> parts_;  // of groups_.members
    struct Candidate {
        int particle;
        std::vector<int> bodies;
    };
    std::vector<Candidate> candidates_;  // fluid particles that may come within the kernel's reach of a surface
};

}  // namespace corpuscle::bodies
